using System.Runtime.InteropServices;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Geometry.Surfaces;

/// <summary>Identifies the vertices of a mesh that lie at exactly the same position.</summary>
public static class VertexWelding
{
    /// <summary>Finds for each vertex the first vertex at the same position.</summary>
    /// <returns>Indices of vertices, [vertices]. Cost O(vertices).</returns>
    public static int[] FindRepresentatives(Mesh mesh)
    {
        ArgumentNullException.ThrowIfNull(mesh);
        var representatives = new int[mesh.VertexCount];
        var firstVertices = new Dictionary<Vector, int>(mesh.VertexCount);
        for (var vertex = 0; vertex < representatives.Length; vertex++)
        {
            ref var first = ref CollectionsMarshal.GetValueRefOrAddDefault(firstVertices, mesh.Vertex(vertex), out var exists);
            representatives[vertex] = first = exists ? first : vertex;
        }

        return representatives;
    }
}
