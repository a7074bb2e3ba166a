using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Tests.Support;

/// <summary>
/// Spells out the meaning of a fractal: every chain of transformations, one after the other, by 3×4 arrays of rows. It shares no arithmetic
/// with the engine.
/// </summary>
internal static class NaiveFractal
{
    /// <summary>Computes p + Pitch·Yaw·Roll·stretch, with the rotation matrices by rows as the format defines them.</summary>
    public static double[][] MapOf(Transformation t)
    {
        var (sx, cx) = Math.SinCos(t.Rotation.X * Math.PI / 180);
        var (sy, cy) = Math.SinCos(t.Rotation.Y * Math.PI / 180);
        var (sz, cz) = Math.SinCos(t.Rotation.Z * Math.PI / 180);
        double[][] pitch = [[1, 0, 0, 0], [0, cx, sx, 0], [0, -sx, cx, 0]];
        double[][] yaw = [[cy, 0, -sy, 0], [0, 1, 0, 0], [sy, 0, cy, 0]];
        double[][] roll = [[cz, sz, 0, 0], [-sz, cz, 0, 0], [0, 0, 1, 0]];
        double[][] scale = [[t.Scale.X, 0, 0, 0], [0, t.Scale.Y, 0, 0], [0, 0, t.Scale.Z, 0]];
        double[][] move = [[1, 0, 0, t.Position.X], [0, 1, 0, t.Position.Y], [0, 0, 1, t.Position.Z]];
        return Compose(move, Compose(pitch, Compose(yaw, Compose(roll, scale))));
    }

    public static double[][] Compose(double[][] first, double[][] second) =>
    [
        .. Enumerable.Range(0, 3).Select(row => Enumerable.Range(0, 4).Select(column =>
            Enumerable.Range(0, 3).Sum(k => first[row][k] * second[k][column]) + (column == 3 ? first[row][3] : 0)).ToArray()),
    ];

    public static Vector Apply(double[][] map, Vector v) => new(Row(map[0], v), Row(map[1], v), Row(map[2], v));

    /// <summary>Returns all sets that a chain passes through, outermost first.</summary>
    public static IEnumerable<IReadOnlyList<Transformation>> Levels(IEnumerable<FractalStep> steps) => steps.SelectMany(step => step switch
    {
        TransformationSet set => [set.Transformations],
        Repetition { Count: { } count } repetition => Enumerable.Repeat(repetition.Round, count).SelectMany(body => Levels(body)),
        _ => throw new ArgumentException("an infinite repetition has no list of levels"),
    });

    /// <summary>Returns the maps of all chains, equal ones too.</summary>
    public static List<double[][]> Chains(FractalDescription description)
    {
        var chains = new List<Transformation[]> { Array.Empty<Transformation>() };
        foreach (var level in Levels(description.Steps))
        {
            chains = [.. chains.SelectMany(chain => level.Select(inner => chain.Append(inner).ToArray()))];
        }

        return [.. chains.Select(chain => description.Composition == Composition.Affine
            ? chain.Select(MapOf).Aggregate(MapOf(Transformation.Identity), Compose)
            : MapOf(chain.Aggregate(Transformation.Identity, ComposeByComponents)))];
    }

    /// <summary>Removes the maps that differ by less than <paramref name="tolerance"/> from an earlier one.</summary>
    public static List<double[][]> Distinct(IEnumerable<double[][]> maps, double tolerance)
    {
        var distinct = new List<double[][]>();
        foreach (var map in maps)
        {
            if (!distinct.Any(other => MaxDifference(map, other) <= tolerance))
            {
                distinct.Add(map);
            }
        }

        return distinct;
    }

    /// <summary>Returns the largest difference of two entries, as a part of the largest entry of both where that is above 1.</summary>
    public static double MaxDifference(double[][] map1, double[][] map2)
    {
        var (difference, largest) = (0.0, 1.0);
        for (var i = 0; i < 12; i++)
        {
            var (entry1, entry2) = (map1[i / 4][i % 4], map2[i / 4][i % 4]);
            difference = Math.Max(difference, Math.Abs(entry1 - entry2));
            largest = Math.Max(largest, Math.Max(Math.Abs(entry1), Math.Abs(entry2)));
        }

        return difference / largest;
    }

    public static double[][] Rows(AffineMap map)
    {
        var (m, p) = (map.Linear, map.Translation);
        return [[m.V1.X, m.V2.X, m.V3.X, p.X], [m.V1.Y, m.V2.Y, m.V3.Y, p.Y], [m.V1.Z, m.V2.Z, m.V3.Z, p.Z]];
    }

    /// <summary>Fails unless both lists have the same maps in any order, each as often as the other.</summary>
    public static void AssertSameMaps(IReadOnlyCollection<double[][]> expected, IEnumerable<AffineMap> actual, double tolerance)
    {
        var unmatched = actual.Select(Rows).ToList();
        Assert.Equal(expected.Count, unmatched.Count);
        foreach (var map in expected)
        {
            var match = unmatched.FindIndex(other => MaxDifference(map, other) <= tolerance);
            Ensure.That(match >= 0, $"no instance is {string.Join(" ", map.SelectMany(row => row))}");
            unmatched.RemoveAt(match);
        }
    }

    public static IEnumerable<Vector> Vertices(Mesh mesh) => Enumerable.Range(0, mesh.VertexCount).Select(mesh.Vertex);

    /// <summary>Returns the corners of all faces of all instances, [faces × 3].</summary>
    public static IEnumerable<Vector> Corners(FractalDescription description, Mesh mesh, double[][] placement) =>
        from chain in Chains(description)
        let map = Compose(placement, chain)
        from vertex in mesh.VertexIndices
        select Apply(map, mesh.Vertex(vertex));

    public static BoundingBox Box(IEnumerable<Vector> points) => points.Aggregate(BoundingBox.Empty, (box, point) => new(
        new(Math.Min(box.Minimum.X, point.X), Math.Min(box.Minimum.Y, point.Y), Math.Min(box.Minimum.Z, point.Z)),
        new(Math.Max(box.Maximum.X, point.X), Math.Max(box.Maximum.Y, point.Y), Math.Max(box.Maximum.Z, point.Z))));

    private static Transformation ComposeByComponents(Transformation outer, Transformation inner) => new(
        outer.Position + inner.Position,
        outer.Rotation + inner.Rotation,
        new(outer.Scale.X * inner.Scale.X, outer.Scale.Y * inner.Scale.Y, outer.Scale.Z * inner.Scale.Z));

    private static double Row(double[] row, Vector v) => (row[0] * v.X) + (row[1] * v.Y) + (row[2] * v.Z) + row[3];
}
