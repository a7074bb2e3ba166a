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
        ArgumentNullException.ThrowIfNull(mesh);
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

    /// <summary>Finds for each vertex the first one within a tolerance, by the cells of a grid that its surroundings lie in.</summary>
    private static int[] FindRepresentatives(Mesh mesh, double tolerance, IProgress<double>? progress)
    {
        var cells = new Dictionary<(long X, long Y, long Z), int>(mesh.VertexCount);
        var representatives = new int[mesh.VertexCount];
        // In tolerances from a vertex, so that the numbers of cells fit also far from the origin. The reciprocal of a tiny one is infinite.
        var origin = mesh.VertexCount == 0 ? Vector.Zero : mesh.Vertex(0) / tolerance;
        for (var vertex = 0; vertex < representatives.Length; vertex++)
        {
            var position = mesh.Vertex(vertex);
            var scaled = (position / tolerance) - origin;
            var (low, high) = (CellOf(scaled - Vector.One), CellOf(scaled + Vector.One));
            representatives[vertex] = -1;
            for (var x = low.X; x <= high.X; x++)
            {
                for (var y = low.Y; y <= high.Y; y++)
                {
                    for (var z = low.Z; z <= high.Z; z++)
                    {
                        if (representatives[vertex] < 0 && cells.TryGetValue((x, y, z), out var other)
                            && (mesh.Vertex(other) - position).LengthSquared() <= tolerance * tolerance)
                        {
                            representatives[vertex] = other;
                        }
                    }
                }
            }

            if (representatives[vertex] < 0)
            {
                representatives[vertex] = vertex;
                cells.Add(CellOf(scaled), vertex);
            }

            progress?.Report(0.5 * (vertex + 1) / representatives.Length);
        }

        return representatives;

        // What shares a cell is the same: its diagonal is the largest distance.
        static (long X, long Y, long Z) CellOf(Vector scaled)
        {
            var (x, y, z) = Math.Sqrt(3) * scaled;
            return ((long)Math.Floor(x), (long)Math.Floor(y), (long)Math.Floor(z));
        }
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
