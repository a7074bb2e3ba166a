using System.Numerics;
using Vector = FractalEngine.Core.Maths.Vector;

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
        // A table of vertices plus one, 0 where free, at most half full: a collision is resolved in the next slots.
        var slots = new int[BitOperations.RoundUpToPowerOf2((2 * (uint)mesh.VertexCount) + 1)];
        var factor = ((ulong)Random.Shared.NextInt64() << 1) | 1;
        for (var vertex = 0; vertex < representatives.Length; vertex++)
        {
            var position = mesh.Vertex(vertex);
            var slot = (int)(Hash(position, factor) >> 32) & (slots.Length - 1);
            while (slots[slot] > 0 && mesh.Vertex(slots[slot] - 1) != position)
            {
                slot = (slot + 1) & (slots.Length - 1);
            }

            slots[slot] = slots[slot] > 0 ? slots[slot] : vertex + 1;
            representatives[vertex] = slots[slot] - 1;
        }

        return representatives;
    }

    /// <summary>Mixes the bits of a position into the higher ones of a number; both zeros are one.</summary>
    /// <param name="position">Finite.</param>
    /// <param name="factor">Odd, and not known to who writes a file: else all of its vertices might share a slot.</param>
    private static ulong Hash(Vector position, ulong factor) =>
        Mix(Mix(Mix(0, position.X, factor), position.Y, factor), position.Z, factor);

    private static ulong Mix(ulong hash, double coordinate, ulong factor)
    {
        var bits = BitConverter.DoubleToUInt64Bits(coordinate + 0.0);
        return (hash ^ bits ^ (bits >> 32)) * factor;
    }
}
