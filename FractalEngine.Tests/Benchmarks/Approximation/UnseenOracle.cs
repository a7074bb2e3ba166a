using FractalEngine.Benchmarks.Approximation.Unseen;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Tests.Benchmarks.Approximation;

/// <summary>Plain ways to find out what tests of unseen inputs expect.</summary>
internal static class UnseenOracle
{
    /// <summary>The seeds that tests go through, which have different bases.</summary>
    public static int[] Seeds => [0, 1, 2, 3, 4, 5];

    /// <summary>Expands all words of given lengths of the generators on all bases, each word by itself.</summary>
    public static Mesh ExpandWords(UnseenInput input, int minLength, int maxLength)
    {
        var (positions, indices) = (new List<Vector>(), new List<int>());
        for (var length = minLength; length <= maxLength; length++)
        {
            for (var word = 0; word < (int)Math.Pow(input.Generators.Length, length); word++)
            {
                var (map, left) = (AffineMap.Identity, word);
                for (var letter = 0; letter < length; letter++)
                {
                    map *= input.Generators[left % input.Generators.Length].Map;
                    left /= input.Generators.Length;
                }

                foreach (var part in input.Bases)
                {
                    indices.AddRange(part.VertexIndices.Select(vertex => positions.Count + vertex));
                    positions.AddRange(MeshTools.Positions(part).Select(position => map * position));
                }
            }
        }

        return MeshTools.Create(positions, indices);
    }

    /// <summary>Counts the connected components of a mesh.</summary>
    public static int CountComponents(Mesh mesh)
    {
        var parents = Enumerable.Range(0, mesh.VertexCount).ToArray();
        for (var i = 0; i < mesh.VertexIndices.Length; i += 3)
        {
            parents[Root(mesh.VertexIndices[i + 1])] = Root(mesh.VertexIndices[i]);
            parents[Root(mesh.VertexIndices[i + 2])] = Root(mesh.VertexIndices[i]);
        }

        return parents.Where((parent, vertex) => parent == vertex).Count();

        int Root(int vertex)
        {
            while (parents[vertex] != vertex)
            {
                parents[vertex] = parents[parents[vertex]];
                vertex = parents[vertex];
            }

            return vertex;
        }
    }

    /// <summary>Lists the edges of all faces in the directions in which the faces pass them.</summary>
    public static IEnumerable<(int From, int To)> DirectedEdges(Mesh mesh) =>
        Enumerable.Range(0, mesh.VertexIndices.Length)
            .Select(i => (mesh.VertexIndices[i], mesh.VertexIndices[i % 3 == 2 ? i - 2 : i + 1]));

    /// <summary>Counts the edges that only one face passes, and those that two faces pass in one direction.</summary>
    public static (int Border, int Doubled) CountBadEdges(Mesh mesh)
    {
        var edges = DirectedEdges(mesh).ToLookup(edge => edge);
        return (edges.Count(edge => !edges.Contains((edge.Key.To, edge.Key.From))), edges.Count(edge => edge.Count() > 1));
    }

    /// <summary>Lists each face by the positions of its corners in a fixed order, the faces sorted: the same for a shuffled mesh.</summary>
    public static string[] FacesInOrder(Mesh mesh) =>
    [
        .. Enumerable.Range(0, mesh.FaceCount).Select(mesh.Face)
            .Select(face => new[] { face.A, face.B, face.C }.Select(corner => corner.ToString()).Order(StringComparer.Ordinal))
            .Select(corners => string.Join(' ', corners))
            .Order(StringComparer.Ordinal),
    ];

    /// <summary>Lists the corners of an element of the undamaged model.</summary>
    public static int[] VerticesOf(UnseenInput input, UnseenElement element) =>
        [.. input.Clean.VertexIndices.AsSpan(3 * element.FirstFace, 3 * element.FaceCount).ToArray().Distinct()];
}
