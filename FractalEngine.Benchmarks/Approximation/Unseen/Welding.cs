using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Benchmarks.Approximation.Unseen;

/// <summary>Merges vertices that lie at one place, whichever part of a model they belong to.</summary>
internal static class Welding
{
    /// <summary>
    /// Welds vertices that are closer than a part of the diagonal, and removes faces without three corners and all but the first of faces
    /// with equal corners, whichever way they are wound.
    /// </summary>
    public static Mesh Weld(Mesh mesh, double relativeTolerance)
    {
        var places = FindPlaces(MeshTools.Positions(mesh), relativeTolerance * mesh.Bounds.Diagonal);
        var (seen, indices) = (new HashSet<(int, int, int)>(), new List<int>());
        for (var i = 0; i < mesh.VertexIndices.Length; i += 3)
        {
            var (a, b, c) = (places[mesh.VertexIndices[i]], places[mesh.VertexIndices[i + 1]], places[mesh.VertexIndices[i + 2]]);
            if (a != b && b != c && c != a && seen.Add(Sorted(a, b, c)))
            {
                indices.AddRange([a, b, c]);
            }
        }

        return MeshTools.TakeFaces(MeshTools.Positions(mesh), indices);
    }

    /// <summary>Finds for each position the index of the first one that lies at the same place.</summary>
    public static int[] FindPlaces(IReadOnlyList<Vector> positions, double tolerance)
    {
        var (index, places) = (new PlaceIndex(tolerance), new int[positions.Count]);
        for (var i = 0; i < places.Length; i++)
        {
            var near = index.Near(positions[i]);
            if (near.Count == 0)
            {
                index.Add(positions[i], i);
            }

            places[i] = near.Count == 0 ? i : near.Min();
        }

        return places;
    }

    /// <summary>Brings the corners of a face into ascending order.</summary>
    public static (int Least, int Middle, int Greatest) Sorted(int a, int b, int c)
    {
        var (least, greatest) = (Math.Min(a, Math.Min(b, c)), Math.Max(a, Math.Max(b, c)));
        return (least, a ^ b ^ c ^ least ^ greatest, greatest);
    }
}
