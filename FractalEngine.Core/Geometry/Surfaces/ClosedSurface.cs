using System.Runtime.InteropServices;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Geometry.Surfaces;

/// <summary>
/// Tests whether a mesh is the closed surface of a solid.
/// </summary>
/// <remarks>From outside, the back faces of such a mesh are never visible and need not be drawn.</remarks>
public static class ClosedSurface
{
    /// <summary>Tests whether a mesh is closed and all its connected components are wound outwards.</summary>
    /// <remarks>
    /// Closed means that the faces pass every edge as often in one direction as in the other, with vertices at the same position welded.
    /// False proves nothing: the inner surface of a hollow solid is wound inwards. Cost O(faces): some 50 ms for 300,000.
    /// </remarks>
    public static bool IsSolid(Mesh mesh)
    {
        var representatives = VertexWelding.FindRepresentatives(mesh);
        if (mesh.FaceCount == 0 || SurfaceEdges.Of(mesh, representatives).OpenCount > 0)
        {
            return false;
        }

        int[] indices = [.. mesh.VertexIndices.Select(vertex => representatives[vertex])];
        var components = new DisjointSets();
        components.Reset(mesh.VertexCount);
        for (var i = 0; i < indices.Length; i++)
        {
            components.Join(indices[i], indices[Mesh.NextCorner(i)]);
        }

        return AreComponentsWoundOutwards(mesh, indices, components);
    }

    private static bool AreComponentsWoundOutwards(Mesh mesh, int[] indices, DisjointSets components)
    {
        var volumes = new Dictionary<int, double>();
        var centre = mesh.Bounds.Centre;
        for (var face = 0; face < mesh.FaceCount; face++)
        {
            var (a, b, c) = mesh.Face(face);
            CollectionsMarshal.GetValueRefOrAddDefault(volumes, components.RootOf(indices[3 * face]), out _) +=
                Vector.Dot(a - centre, Vector.Cross(b - centre, c - centre));
        }

        // Flat components have a volume of rounding errors only, and don't count as solid.
        var size = mesh.Bounds.Diagonal;
        return volumes.Values.All(volume => volume > 1e-12 * size * size * size);
    }
}
