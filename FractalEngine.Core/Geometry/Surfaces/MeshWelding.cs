using System.Runtime.InteropServices;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Geometry.Surfaces;

/// <summary>Joins the surfaces of solids that stand side by side: vertices that coincide become one, and walls between solids go.</summary>
public static class MeshWelding
{
    // Of areas of sides that coincide, relative.
    private const double AreaTolerance = 1e-6;

    /// <summary>Welds a mesh of solids side by side.</summary>
    /// <param name="mesh">Mesh of many parts, of which positions, faces and groups are kept.</param>
    /// <param name="sides">For each face the number of the flat side that it belongs to, as <see cref="FindSides"/> gives them.</param>
    /// <param name="tolerance">Largest distance of vertices that coincide, scene units, above 0.</param>
    /// <param name="progress">Told the part of the work that is done, from 0 to 1; null for nobody.</param>
    /// <returns>
    /// The mesh without vertices that no face uses. Two sides with the same corners go where they face each other, and one of two goes
    /// where they face the same way.
    /// </returns>
    /// <remarks>Cost O(faces): some microseconds and 300 bytes each.</remarks>
    public static Mesh Weld(Mesh mesh, ReadOnlySpan<int> sides, double tolerance, IProgress<double>? progress = null)
    {
        ArgumentNullException.ThrowIfNull(mesh);
        ArgumentOutOfRangeException.ThrowIfNegativeOrZero(tolerance);
        ArgumentOutOfRangeException.ThrowIfNotEqual(sides.Length, mesh.FaceCount);
        var representatives = FindRepresentatives(mesh, tolerance, progress);
        var isDropped = FindDoubleSides(mesh, sides, representatives, tolerance, progress);
        var (positions, indices) = (new List<double>(), new List<int>());
        var numbers = new Dictionary<int, int>();
        var keptBefore = new int[mesh.FaceCount + 1];
        for (var face = 0; face < mesh.FaceCount; face++)
        {
            var corners = Corners(mesh, representatives, face);
            var isKept = !isDropped[sides[face]] && corners.A != corners.B && corners.B != corners.C && corners.C != corners.A;
            keptBefore[face + 1] = keptBefore[face] + (isKept ? 1 : 0);
            foreach (var vertex in isKept ? [corners.A, corners.B, corners.C] : ReadOnlySpan<int>.Empty)
            {
                ref var number = ref CollectionsMarshal.GetValueRefOrAddDefault(numbers, vertex, out var exists);
                if (!exists)
                {
                    number = positions.Count / 3;
                    positions.AddRange(mesh.Positions.AsSpan(3 * vertex, 3));
                }

                indices.Add(number);
            }
        }

        var groups = mesh.Groups.Select(group => group with
        {
            FirstFace = keptBefore[group.FirstFace],
            FaceCount = keptBefore[group.FirstFace + group.FaceCount] - keptBefore[group.FirstFace],
        });
        return new Mesh([.. positions], [.. indices]).WithGroups([.. groups.Where(static group => group.FaceCount > 0)], []);
    }

    /// <summary>Finds the flat sides of a mesh: faces of one plane that are connected by edges.</summary>
    /// <returns>For each face the number of its side, from 0 and below that of the faces, [faces].</returns>
    public static int[] FindSides(Mesh mesh)
    {
        var representatives = VertexWelding.FindRepresentatives(mesh);
        var sides = new DisjointSets();
        sides.Reset(mesh.FaceCount);
        var faces = new Dictionary<(int From, int To), int>();
        for (var i = 0; i < mesh.VertexIndices.Length; i++)
        {
            var from = representatives[mesh.VertexIndices[i]];
            var to = representatives[mesh.VertexIndices[Mesh.NextCorner(i)]];
            if (faces.TryGetValue((to, from), out var neighbour) && MeshFeatures.IsFlat(mesh, i / 3, neighbour))
            {
                sides.Join(i / 3, neighbour);
            }

            faces[(from, to)] = i / 3;
        }

        return [.. Enumerable.Range(0, mesh.FaceCount).Select(sides.RootOf)];
    }

    /// <summary>Finds for each vertex an earlier one within a tolerance that stands for itself; else it does so.</summary>
    private static int[] FindRepresentatives(Mesh mesh, double tolerance, IProgress<double>? progress)
    {
        Vector[] points = [.. Enumerable.Range(0, mesh.VertexCount).Select(mesh.Vertex)];
        var grid = new PointGrid(points, tolerance, isEmpty: true);
        var representatives = new int[points.Length];
        for (var vertex = 0; vertex < points.Length; vertex++)
        {
            var known = grid.First(points[vertex]);
            representatives[vertex] = known < 0 ? vertex : grid.PointOf(known);
            if (known < 0)
            {
                grid.Add(vertex);
            }

            progress?.Report(0.5 * (vertex + 1) / points.Length);
        }

        return representatives;
    }

    private static bool[] FindDoubleSides(
        Mesh mesh, ReadOnlySpan<int> sides, int[] representatives, double tolerance, IProgress<double>? progress)
    {
        var areas = new Vector[mesh.FaceCount];
        var corners = new HashSet<(int Side, int Vertex)>();
        var keys = new (ulong Sum, ulong Mix)[mesh.FaceCount];
        for (var face = 0; face < mesh.FaceCount; face++)
        {
            var (a, b, c) = Corners(mesh, representatives, face);
            // In squares of the tolerance, which no size of a mesh takes beyond numbers.
            areas[sides[face]] += Vector.Cross(
                (mesh.Vertex(b) - mesh.Vertex(a)) / tolerance, (mesh.Vertex(c) - mesh.Vertex(a)) / tolerance);
            foreach (var vertex in (ReadOnlySpan<int>)[a, b, c])
            {
                if (corners.Add((sides[face], vertex)))
                {
                    var mixed = HashMixing.Mix((ulong)vertex + 1);
                    ref var key = ref keys[sides[face]];
                    key = (key.Sum + mixed, key.Mix + HashMixing.Mix(mixed));
                }
            }

            progress?.Report(0.5 + (0.5 * (face + 1) / mesh.FaceCount));
        }

        var isDropped = new bool[mesh.FaceCount];
        var singles = new Dictionary<(ulong Sum, ulong Mix), int>();
        for (var side = 0; side < keys.Length; side++)
        {
            if (keys[side] == default)
            {
                continue;
            }

            if (!singles.TryGetValue(keys[side], out var other))
            {
                singles.Add(keys[side], side);
                continue;
            }

            var difference = AreaTolerance * areas[side].Length();
            isDropped[side] = (areas[side] - areas[other]).Length() <= difference;
            if ((areas[side] + areas[other]).Length() <= difference)
            {
                // The one before stays known: further ones lie within, too.
                (isDropped[side], isDropped[other]) = (true, true);
            }
        }

        return isDropped;
    }

    private static (int A, int B, int C) Corners(Mesh mesh, int[] representatives, int face)
    {
        var indices = mesh.VertexIndices.AsSpan(3 * face, 3);
        return (representatives[indices[0]], representatives[indices[1]], representatives[indices[2]]);
    }
}
