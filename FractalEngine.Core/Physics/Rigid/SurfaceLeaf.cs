using FractalEngine.Core.Geometry.Surfaces;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Queries.Regions;

namespace FractalEngine.Core.Physics.Rigid;

/// <summary>
/// A small part of a surface: its triangles, and those of their corners and edges that no other triangle has been given.
/// </summary>
internal sealed class SurfaceLeaf
{
    /// <summary>Makes a leaf of balls and capsules: triangles without area.</summary>
    public SurfaceLeaf(SurfaceTriangle[] triangles)
    {
        Triangles = triangles;
        Corners = new SurfaceCorner[2 * triangles.Length];
        Edges = new SurfaceEdge[triangles.Length];
        for (var i = 0; i < triangles.Length; i++)
        {
            var (a, b, _) = triangles[i].Corners;
            Corners[2 * i] = new(a, Vector.Zero, triangles[i].Rounding, i);
            Corners[(2 * i) + 1] = new(b, Vector.Zero, triangles[i].Rounding, i);
            Edges[i] = new(a, b, Vector.Zero, Vector.Zero, triangles[i].Rounding, i);
        }
    }

    /// <summary>Makes a leaf of the tree of a mesh or fractal.</summary>
    public SurfaceLeaf(ShapeNodes nodes, int leaf)
    {
        var source = nodes.Triangles(leaf);
        var features = MeshFeatures.For(nodes.BaseMesh(leaf));
        Triangles = new SurfaceTriangle[source.Length];
        var linear = nodes.MapOf(leaf).Linear;
        var corners = new List<SurfaceCorner>();
        var edges = new List<SurfaceEdge>();
        for (var i = 0; i < source.Length; i++)
        {
            Triangles[i] = new(source[i].Corners, 0);
            var (a, b, c) = source[i].Corners;
            for (var side = 0; side < 3; side++)
            {
                var (start, end) = side == 0 ? (a, b) : side == 1 ? (b, c) : (c, a);
                if (features.HasVertex(source[i].Face, side))
                {
                    corners.Add(new(start, linear * features.InwardsFrom(source[i].Face, side), 0, i));
                }

                if (features.HasEdge(source[i].Face, side, out var neighbour))
                {
                    var other = new SurfaceTriangle(nodes.Corners(leaf, neighbour), 0);
                    edges.Add(new(start, end, Triangles[i].Normal, other.Normal, 0, i));
                }
            }
        }

        Corners = [.. corners];
        Edges = [.. edges];
    }

    /// <summary>The triangles, in the frame of the surface.</summary>
    public SurfaceTriangle[] Triangles { get; }

    /// <summary>The corners; of balls and capsules the ends.</summary>
    public SurfaceCorner[] Corners { get; }

    /// <summary>The edges; those between triangles of one plane are not listed.</summary>
    public SurfaceEdge[] Edges { get; }
}
