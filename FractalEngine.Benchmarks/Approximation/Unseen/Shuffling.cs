using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Benchmarks.Approximation.Unseen;

/// <summary>Removes all that the order of a mesh tells about how it was made.</summary>
internal static class Shuffling
{
    private const int FacesPerTurned = 10;

    /// <summary>
    /// Brings vertices and faces into a random order, lets each face begin at a random corner, and turns every tenth face, rounded down.
    /// </summary>
    public static Mesh Shuffle(Mesh mesh, SeededRandom random)
    {
        var placeOf = random.Permutation(mesh.VertexCount);
        var positions = new Vector[mesh.VertexCount];
        for (var i = 0; i < positions.Length; i++)
        {
            positions[placeOf[i]] = mesh.Vertex(i);
        }

        var order = random.Permutation(mesh.FaceCount);
        var indices = new int[3 * order.Length];
        var turned = order.Length / FacesPerTurned;
        for (var face = 0; face < order.Length; face++)
        {
            var first = random.Index(3);
            for (var corner = 0; corner < 3; corner++)
            {
                indices[(3 * face) + corner] = placeOf[mesh.VertexIndices[(3 * order[face]) + ((first + corner) % 3)]];
            }
        }

        foreach (var face in random.Permutation(order.Length).AsSpan(0, turned))
        {
            (indices[(3 * face) + 1], indices[(3 * face) + 2]) = (indices[(3 * face) + 2], indices[(3 * face) + 1]);
        }

        return MeshTools.Create(positions, indices);
    }
}
