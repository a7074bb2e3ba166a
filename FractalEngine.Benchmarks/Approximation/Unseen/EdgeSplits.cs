using FractalEngine.Core.Geometry;

namespace FractalEngine.Benchmarks.Approximation.Unseen;

/// <summary>Splits edges of a mesh, which leaves its surface as it is.</summary>
internal static class EdgeSplits
{
    /// <summary>Splits a fraction of the edges, each at a random point between a fifth and four fifths of it.</summary>
    public static Mesh Apply(Mesh mesh, double fraction, SeededRandom random)
    {
        var table = new EdgeTable(mesh.VertexIndices);
        var positions = MeshTools.Positions(mesh).ToList();
        foreach (var index in random.Permutation(table.InitialEdges).Take((int)Math.Round(fraction * table.InitialEdges)))
        {
            // No split takes an edge away other than the one that it splits.
            var (a, b) = table.Edge(index);
            var middle = positions.Count;
            positions.Add(positions[a] + (random.Between(0.2, 0.8) * (positions[b] - positions[a])));
            foreach (var face in table.FacesAt(a, b).ToArray())
            {
                // The face keeps a; a new one, with its corners in the same order, has b.
                int[] other = [table.Indices[3 * face], table.Indices[(3 * face) + 1], table.Indices[(3 * face) + 2]];
                other[Array.IndexOf(other, a)] = middle;
                table.Replace(face, b, middle);
                table.Add(other[0], other[1], other[2]);
            }
        }

        return MeshTools.Create(positions, [.. table.Indices]);
    }
}
