using System.Runtime.InteropServices;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Geometry.Surfaces;

/// <summary>What the edges of a mesh tell of its surface, with vertices at exactly the same position as one.</summary>
/// <param name="OpenCount">Number of edges that faces pass more often in one direction than in the other: none where it is closed.</param>
/// <param name="TouchingCount">Number of further edges with more than two faces, where surfaces touch.</param>
/// <param name="FirstOpen">The middle of the first open edge in the order of the faces; null where there is none.</param>
public readonly record struct SurfaceEdges(int OpenCount, int TouchingCount, Vector? FirstOpen)
{
    /// <summary>Counts the edges of a mesh. Cost O(faces): about 0.2 s for 300,000.</summary>
    public static SurfaceEdges Of(Mesh mesh)
    {
        ArgumentNullException.ThrowIfNull(mesh);
        return Of(mesh, VertexWelding.FindRepresentatives(mesh));
    }

    /// <summary>Counts the edges of a mesh whose vertices have been compared.</summary>
    internal static SurfaceEdges Of(Mesh mesh, int[] representatives)
    {
        var edges = new Dictionary<(int From, int To), (int Balance, int Count)>(2 * mesh.FaceCount);
        for (var i = 0; i < mesh.VertexIndices.Length; i++)
        {
            var from = representatives[mesh.VertexIndices[i]];
            var to = representatives[mesh.VertexIndices[i % 3 == 2 ? i - 2 : i + 1]];
            if (from == to)
            {
                // That of a face without an area.
                continue;
            }

            ref var edge = ref CollectionsMarshal.GetValueRefOrAddDefault(edges, (Math.Min(from, to), Math.Max(from, to)), out _);
            edge = (edge.Balance + Math.Sign(to - from), edge.Count + 1);
        }

        var open = edges.Where(static edge => edge.Value.Balance != 0).Select(static edge => edge.Key).ToArray();
        return new(
            open.Length, edges.Count(static edge => edge.Value is { Balance: 0, Count: > 2 }),
            open is [var (first, second), ..] ? 0.5 * (mesh.Vertex(first) + mesh.Vertex(second)) : null);
    }
}
