using System.Runtime.InteropServices;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Geometry;

/// <summary>
/// Tells whether a mesh is a solid's skin. From outside, the back faces of such a mesh are never seen and need not be drawn.
/// </summary>
public static class ClosedSurface
{
    /// <summary>
    /// True when every edge is passed as often in one direction as in the other, vertices at the same place taken as one, and every
    /// connected part is wound outwards. False proves nothing: a hollow solid's inner skin is wound inwards.
    /// </summary>
    /// <remarks>Cost O(faces): about 0.2 s for 300,000.</remarks>
    public static bool IsSolid(Mesh mesh)
    {
        var (indices, positionCount) = Weld(mesh);
        var edgeBalance = new Dictionary<(int From, int To), int>(indices.Length);
        var components = new int[positionCount];
        for (var i = 0; i < components.Length; i++)
        {
            components[i] = i;
        }

        for (var i = 0; i < indices.Length; i++)
        {
            var (from, to) = (indices[i], indices[i % 3 == 2 ? i - 2 : i + 1]);
            CollectionsMarshal.GetValueRefOrAddDefault(edgeBalance, from < to ? (from, to) : (to, from), out _) += Math.Sign(to - from);
            components[FindComponent(components, from)] = FindComponent(components, to);
        }

        return mesh.FaceCount > 0 && edgeBalance.Values.All(static count => count == 0)
            && AreComponentsWoundOutwards(mesh, indices, components);
    }

    private static (int[] Corners, int Positions) Weld(Mesh mesh)
    {
        var indexOfPosition = new Dictionary<Vector, int>(mesh.VertexCount);
        var indices = new int[mesh.VertexIndices.Length];
        for (var i = 0; i < indices.Length; i++)
        {
            ref var index = ref CollectionsMarshal.GetValueRefOrAddDefault(indexOfPosition, mesh.Vertex(mesh.VertexIndices[i]),
                out var exists);
            indices[i] = index = exists ? index : indexOfPosition.Count - 1;
        }

        return (indices, indexOfPosition.Count);
    }

    /// <summary>The representative of a vertex's connected part, with the paths to it halved on the way.</summary>
    private static int FindComponent(int[] components, int vertex)
    {
        while (components[vertex] != vertex)
        {
            vertex = components[vertex] = components[components[vertex]];
        }

        return vertex;
    }

    private static bool AreComponentsWoundOutwards(Mesh mesh, int[] indices, int[] components)
    {
        var volumes = new Dictionary<int, double>();
        var centre = mesh.Bounds.Centre;
        for (var face = 0; face < mesh.FaceCount; face++)
        {
            var (a, b, c) = mesh.Face(face);
            CollectionsMarshal.GetValueRefOrAddDefault(volumes, FindComponent(components, indices[3 * face]), out _) +=
                Vector.Dot(a - centre, Vector.Cross(b - centre, c - centre));
        }

        // Flat parts have a volume of rounding errors only and don't count as solid.
        var size = mesh.Bounds.Diagonal;
        return volumes.Values.All(volume => volume > 1e-12 * size * size * size);
    }
}
