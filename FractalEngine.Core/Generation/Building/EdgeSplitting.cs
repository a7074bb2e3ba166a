namespace FractalEngine.Core.Generation.Building;

/// <summary>
/// Brings a mesh to an exact number of faces by halving its longest edges. The surface stays the same.
/// </summary>
/// <remarks>
/// An edge between two faces gives two more faces, an edge of one face one more. So a mesh with a border can reach every number, and a
/// closed mesh every other one.
/// </remarks>
internal static class EdgeSplitting
{
    /// <summary>Splits edges until a mesh has a number of faces, or one less where a closed mesh can't reach it.</summary>
    public static void SplitTo(MeshBuilder mesh, int faceCount)
    {
        while (mesh.FaceCount < faceCount && SplitLongestEdges(mesh, faceCount))
        {
        }
    }

    /// <summary>Splits the longest edges in one round, which splits each face at most once.</summary>
    /// <returns>False when no edge could be split.</returns>
    private static bool SplitLongestEdges(MeshBuilder mesh, int faceCount)
    {
        var edges = CollectEdges(mesh);
        var order = edges.Where(edge => edge.Value.Count <= 2)
            .Select(edge => (edge.Key, edge.Value.First, edge.Value.Second, Length: Length(mesh, edge.Key)))
            .OrderByDescending(edge => edge.Length).ThenBy(edge => edge.Key.Low).ThenBy(edge => edge.Key.High);
        var touched = new HashSet<int>();
        var changed = false;
        var isMissingOdd = (faceCount - mesh.FaceCount) % 2 == 1;
        foreach (var ((low, high), first, second, _) in order)
        {
            var missing = faceCount - mesh.FaceCount;
            // One border edge makes an odd number of missing faces even; all others are inner edges.
            if (missing == 0 || (second < 0 ? !isMissingOdd : missing < 2) || touched.Contains(first) || touched.Contains(second))
            {
                continue;
            }

            var midpoint = mesh.AddPosition(0.5 * (mesh.Positions[low] + mesh.Positions[high]));
            Split(mesh, first, low, high, midpoint);
            touched.Add(first);
            if (second >= 0)
            {
                Split(mesh, second, low, high, midpoint);
                touched.Add(second);
            }
            else
            {
                isMissingOdd = false;
            }

            changed = true;
        }

        return changed;
    }

    private static double Length(MeshBuilder mesh, (int Low, int High) edge) =>
        (mesh.Positions[edge.Low] - mesh.Positions[edge.High]).Length();

    /// <summary>Collects all edges with the first two of their faces, −1 for none, and the number of their faces.</summary>
    private static Dictionary<(int Low, int High), (int First, int Second, int Count)> CollectEdges(MeshBuilder mesh)
    {
        var edges = new Dictionary<(int Low, int High), (int First, int Second, int Count)>(2 * mesh.FaceCount);
        for (var face = 0; face < mesh.FaceCount; face++)
        {
            for (var corner = 0; corner < 3; corner++)
            {
                var (a, b, _, _) = mesh.Triangles[face].StartingAt(corner);
                var edge = (Math.Min(a.PositionIndex, b.PositionIndex), Math.Max(a.PositionIndex, b.PositionIndex));
                edges[edge] = edges.TryGetValue(edge, out var known) ? (known.First, face, known.Count + 1) : (face, -1, 1);
            }
        }

        return edges;
    }

    /// <summary>Replaces a face by its two halves on both sides of the midpoint of an edge.</summary>
    private static void Split(MeshBuilder mesh, int face, int low, int high, int midpoint)
    {
        for (var corner = 0; corner < 3; corner++)
        {
            var (a, b, c, smoothing) = mesh.Triangles[face].StartingAt(corner);
            if ((a.PositionIndex == low && b.PositionIndex == high) || (a.PositionIndex == high && b.PositionIndex == low))
            {
                var between = new MeshCorner(midpoint, mesh.AddCoordinateMidpoint(a.CoordinateIndex, b.CoordinateIndex));
                mesh.Triangles[face] = new(a, between, c, smoothing);
                mesh.Triangles.Add(new(between, b, c, smoothing));
                return;
            }
        }
    }
}
