using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Physics.Rigid;

/// <summary>What a leaf of one surface has near a box of the other: triangles, corners and edges, where a placement has them.</summary>
internal sealed class LeafFeatures
{
    private SurfaceMotion _placement;

    /// <summary>The leaf that they are of.</summary>
    public SurfaceLeaf Leaf { get; private set; } = null!;

    /// <summary>Index of the leaf in its tree.</summary>
    public int Index { get; private set; }

    /// <summary>The triangles, with their indices in the leaf.</summary>
    public List<(SurfaceTriangle Placed, int Index)> Triangles { get; } = [];

    /// <summary>The corners that are given to triangles of the leaf.</summary>
    public List<SurfaceCorner> Corners { get; } = [];

    /// <summary>The edges that are given to triangles of the leaf.</summary>
    public List<SurfaceEdge> Edges { get; } = [];

    /// <summary>Collects what is near a box.</summary>
    /// <param name="nodes">The surface.</param>
    /// <param name="index">Index of the leaf in its tree.</param>
    /// <param name="placement">Where it is.</param>
    /// <param name="box">The box, in the same frame.</param>
    /// <param name="margin">What is farther from the box is left out, mostly.</param>
    public void Collect(SurfaceNodes nodes, int index, in SurfaceMotion placement, in SurfaceBox box, double margin)
    {
        (Index, Leaf, _placement) = (index, nodes.Leaf(index), placement);
        Triangles.Clear();
        Corners.Clear();
        Edges.Clear();
        for (var i = 0; i < Leaf.Triangles.Length; i++)
        {
            var triangle = Leaf.Triangles[i].Place(in placement);
            var height = Math.Abs(Vector.Dot(triangle.Normal, box.Centre - triangle.Corners.A));
            if (height <= box.Extent(triangle.Normal) + margin + triangle.Rounding
                && IsNear(in box, margin + triangle.Rounding, triangle.Corners.A, triangle.Corners.B, triangle.Corners.C))
            {
                Triangles.Add((triangle, i));
            }
        }

        foreach (ref readonly var corner in Leaf.Corners.AsSpan())
        {
            var placed = corner.Place(in placement);
            if (IsNear(in box, margin + placed.Rounding, placed.Position, placed.Position, placed.Position))
            {
                Corners.Add(placed);
            }
        }

        foreach (ref readonly var edge in Leaf.Edges.AsSpan())
        {
            var placed = edge.Place(in placement);
            if (IsNear(in box, margin + placed.Rounding, placed.Start, placed.End, placed.End))
            {
                Edges.Add(placed);
            }
        }
    }

    /// <summary>Places a triangle of the leaf, whether it is near or not.</summary>
    public SurfaceTriangle Triangle(int index) => Leaf.Triangles[index].Place(in _placement);

    private static bool IsNear(in SurfaceBox box, double margin, Vector a, Vector b, Vector c)
    {
        var centre = box.Centre;
        var normals = box.Normals;
        return IsNear(in box, normals.V1, margin, a - centre, b - centre, c - centre)
            && IsNear(in box, normals.V2, margin, a - centre, b - centre, c - centre)
            && IsNear(in box, normals.V3, margin, a - centre, b - centre, c - centre);
    }

    private static bool IsNear(in SurfaceBox box, Vector axis, double margin, Vector a, Vector b, Vector c)
    {
        var reach = box.Extent(axis) + margin;
        var (heightA, heightB, heightC) = (Vector.Dot(axis, a), Vector.Dot(axis, b), Vector.Dot(axis, c));
        return Math.Min(heightA, Math.Min(heightB, heightC)) <= reach && Math.Max(heightA, Math.Max(heightB, heightC)) >= -reach;
    }
}
