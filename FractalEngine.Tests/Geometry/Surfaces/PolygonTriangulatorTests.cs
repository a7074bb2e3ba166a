using FractalEngine.Core.Geometry.Surfaces;
using FractalEngine.Core.Maths;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Geometry.Surfaces;

public class PolygonTriangulatorTests
{
    public static TheoryData<string, double[]> Concave { get; } = new()
    {
        { "arrow", [0, 0, 4, 2, 0, 4, 1, 2] },
        { "L", [0, 0, 3, 0, 3, 1, 1, 1, 1, 3, 0, 3] },
        { "comb", [0, 0, 7, 0, 7, 3, 6, 3, 6, 1, 5, 1, 5, 3, 4, 3, 4, 1, 3, 1, 3, 3, 2, 3, 2, 1, 1, 1, 1, 3, 0, 3] },
        { "spiral", [0, 0, 10, 0, 10, 10, 2, 10, 2, 4, 6, 4, 6, 6, 4, 6, 4, 8, 8, 8, 8, 2, 0, 2] },
        { "corner on an edge's line", [0, 0, 2, 0, 2, 1, 3, 1, 3, 0, 5, 0, 5, 3, 0, 3] },
        { "collinear corners", [0, 0, 1, 0, 2, 0, 3, 0, 3, 3, 2, 3, 2, 1, 1, 1, 1, 3, 0, 3] },
    };

    public static TheoryData<string, double[]> Degenerate { get; } = new()
    {
        { "one point four times", [1, 1, 1, 1, 1, 1, 1, 1] },
        { "on one line", [0, 0, 1, 0, 2, 0, 3, 0, 4, 0] },
        { "there and back", [0, 0, 1, 0, 2, 0, 1, 0] },
        { "bow tie", [0, 0, 1, 1, 1, 0, 0, 1] },
        { "pentagram", [0, 3, 2, -3, -3, 1, 3, 1, -2, -3] },
        { "repeated corners", [0, 0, 0, 0, 1, 0, 1, 0, 1, 1, 1, 1, 0, 1, 0, 1] },
        { "a spike", [0, 0, 2, 0, 2, 1, 5, 1, 2, 1, 0, 1] },
        { "a bridge to a hole", [0, 0, 4, 0, 4, 4, 0, 4, 0, 0, 1, 1, 1, 3, 3, 3, 3, 1, 1, 1] },
        { "a huge and a tiny corner", [0, 0, 1e150, 0, 1e150, 1e150, 1e-150, 1e-150, 0, 1] },
        { "no numbers", [0, 0, double.NaN, 0, 1, 1, 0, 1] },
    };

    [Fact]
    public void Triangulate_ATriangle_GivesItself() =>
        Assert.Equal([0, 1, 2], Triangulate([Vector.Zero, Vector.I, Vector.J]).SelectMany(t => t).Order());

    [Theory]
    [MemberData(nameof(Concave))]
    public void Triangulate_AConcavePolygon_CoversItAndNothingElse(string name, double[] coordinates) => Seeded.Run(20, random =>
    {
        var failure = Record.Exception(() => AssertCovered(random, ToPoints(coordinates), random.Next(2) == 0));
        Assert.True(failure is null, $"{name}: {failure?.Message}");
    });

    [Fact]
    public void Triangulate_ARandomStar_CoversItAndNothingElse() => Seeded.Run(300, random =>
    {
        var count = random.Next(3, 40);
        var polygon = new (double X, double Y)[count];
        for (var i = 0; i < count; i++)
        {
            var angle = (i + random.Between(0.05, 0.95)) * 2 * Math.PI / count;
            var radius = random.Between(0.2, 3);
            polygon[i] = (radius * Math.Cos(angle), radius * Math.Sin(angle));
        }

        AssertCovered(random, polygon, random.Next(2) == 0);
    });

    [Fact]
    public void Triangulate_ARandomBand_CoversItAndNothingElse() => Seeded.Run(100, random =>
    {
        // A zigzag band of constant height: concave, and not a star.
        var lower = Enumerable.Range(0, random.Next(2, 20)).Select(i => (X: (double)i, Y: random.Between(-5, 5))).ToArray();
        AssertCovered(random, [.. lower, .. lower.Reverse().Select(p => (p.X, p.Y + 0.5))], random.Next(2) == 0);
    });

    [Theory]
    [MemberData(nameof(Degenerate))]
    public void Triangulate_ADegeneratePolygon_GivesTwoTrianglesLessThanCornersOverThem(string name, double[] coordinates)
    {
        var triangles = Triangulate([.. ToPoints(coordinates).Select(p => new Vector(p.X, p.Y, 0))]);
        Assert.Equal((name, (coordinates.Length / 2) - 2), (name, triangles.Count));
        Assert.All(triangles.SelectMany(t => t), corner => Assert.InRange(corner, 0, (coordinates.Length / 2) - 1));
    }

    [Fact]
    public void Triangulate_RandomCrossingPolygonsInSpace_GivesTwoTrianglesLessThanCorners() => Seeded.Run(300, random =>
    {
        var corners = Enumerable.Range(0, random.Next(3, 30)).Select(_ => random.Next(4) == 0 ? Vector.Zero : random.Vector()).ToArray();
        Assert.Equal(corners.Length - 2, Triangulate(corners).Count);
    });

    [Fact]
    public void IsConvex_OfAQuadrilateral_TellsHowItIsCut()
    {
        var convexCount = 0;
        Seeded.Run(2000, random =>
        {
            Vector[] corners = random.Next(3) == 0
                ? [random.Vector(), random.Vector(), random.Vector(), random.Vector()]
                : [.. CreateNearlySquare(random)];
            if (PolygonTriangulator.IsConvex(corners[0], corners[1], corners[2], corners[3]))
            {
                Assert.Equal([3, 0, 1, 1, 2, 3], Triangulate(corners).SelectMany(triangle => triangle));
                convexCount++;
            }
        });
        Assert.InRange(convexCount, 500, 1900);
    }

    [Theory]
    [InlineData(0, 0, 1, 0, 2, 0, 1, 1)]
    [InlineData(0, 0, 4, 2, 0, 4, 1, 2)]
    [InlineData(0, 0, 1, 0, 0, 1, 1, 1)]
    [InlineData(0, 0, 0, 0, 1, 0, 1, 1)]
    [InlineData(-1e308, 0, 1e308, 0, 1e308, 1, -1e308, 1)]
    public void IsConvex_OfOthers_IsFalse(double x1, double y1, double x2, double y2, double x3, double y3, double x4, double y4) =>
        Assert.False(PolygonTriangulator.IsConvex(new(x1, y1, 0), new(x2, y2, 0), new(x3, y3, 0), new(x4, y4, 0)));

    private static IEnumerable<Vector> CreateNearlySquare(Random random)
    {
        var axes = random.Degrees().LocalAxesFromDegrees();
        Vector[] square = [Vector.Zero, Vector.I, Vector.I + Vector.J, Vector.J];
        return square.Select(corner => axes * (corner + random.Vector(0.4)));
    }

    [Fact]
    public void Triangulate_ALargeCircle_TakesNoQuadraticTime()
    {
        var angles = Enumerable.Range(0, 20_000).Select(i => i * 2 * Math.PI / 20_000);
        var circle = angles.Select(angle => new Vector(Math.Cos(angle), Math.Sin(angle), 0)).ToArray();
        // It takes milliseconds. The square of the corners would be 400 million.
        Assert.Equal(19_998, ProcessorTime.RunWithin(2, () => Triangulate(circle).Count));
    }

    [Theory]
    [InlineData("comb")]
    [InlineData("spiral")]
    [InlineData("nested fans")]
    [InlineData("one place")]
    [InlineData("crossing")]
    [InlineData("one line")]
    public void Triangulate_TheHardestOf20000Corners_TakesSecondsAtMost(string name)
    {
        const int count = 20_000;
        var random = new Random(1);
        Vector[] polygon = name switch
        {
            // Thin teeth: each long ear has all reflex corners beside it.
            "comb" => [.. Enumerable.Range(0, count).Select(i => new Vector(i, i % 2 == 0 ? 0 : 1000 + (i % 7), 0)), new(count, -1, 0)],
            "spiral" => [.. Spiral(count / 2, 0), .. Spiral(count / 2, 0.1).Reverse()],
            // A chain that is reflex everywhere, seen from one corner only.
            "nested fans" => [.. Enumerable.Range(0, count).Select(i => new Vector(i, (double)i * i / count, 0)), new(0, count, 0)],
            "one place" => [.. Enumerable.Range(0, count).Select(i => i % 2 == 0 ? Vector.Zero : random.Vector())],
            "crossing" => [.. Enumerable.Range(0, count).Select(_ => random.Vector())],
            _ => [.. Enumerable.Range(0, count).Select(i => new Vector(i, 0, 0))],
        };
        // The test of every corner against every other after each cut would take an hour.
        Assert.Equal(polygon.Length - 2, ProcessorTime.RunWithin(2, () => Triangulate(polygon).Count));

        static IEnumerable<Vector> Spiral(int corners, double inset) => Enumerable.Range(0, corners)
            .Select(i => (Angle: i * 0.05, Radius: 1 + (i * 0.05 / (2 * Math.PI)) - inset))
            .Select(place => new Vector(place.Radius * Math.Cos(place.Angle), place.Radius * Math.Sin(place.Angle), 0));
    }

    [Fact]
    public void Triangulate_ASimplePolygon_ClipsTheEarsOfPlainEarClipping() => Seeded.Run(200, random =>
    {
        var angles = Enumerable.Range(0, random.Next(4, 60)).Select(_ => random.Between(0, 2 * Math.PI)).Order().ToArray();
        Vector[] polygon = [.. angles.Select(angle => random.Between(0.2, 3) * new Vector(Math.Cos(angle), Math.Sin(angle), 0))];
        var plain = PlainEarClipping.Triangulate(polygon);
        var triangles = Triangulate(polygon);
        Assert.Equal(plain.SkipLast(1), triangles.SkipLast(1));
        Assert.Equal(plain[^1].Order(), triangles[^1].Order());
    });

    [Fact]
    public void Triangulate_APolygonThatTouchesItself_CoversItAndNothingElse() => Seeded.Run(500, random =>
    {
        var polygon = TouchingPolygons.Create(random, random.Next(2, 12));
        var triangles = Triangulate([.. polygon.Select(p => new Vector(p.X, p.Y, 0))]);
        var area = Enumerable.Range(0, polygon.Count).Sum(i => Cross(polygon[i], polygon[(i + 1) % polygon.Count])) / 2;
        (double X, double Y)[] corners = [.. polygon];
        // Areas are whole numbers or halves, so the sums are exact.
        Assert.Equal(polygon.Count - 2, triangles.Count);
        Assert.Equal(area, triangles.Sum(triangle => Area(corners, triangle)));
        Assert.Equal(area, triangles.Sum(triangle => Math.Abs(Area(corners, triangle))));
    });

    [Theory]
    [InlineData(1e160)]
    [InlineData(1e300)]
    [InlineData(1e-160)]
    [InlineData(1e-300)]
    public void Triangulate_APolygonOfExtremeSize_CutsItAsOneOfUsualSize(double size)
    {
        double[] coordinates = [0, 0, 3, 0, 3, 1, 1, 1, 1, 3, 0, 3];
        var usual = Triangulate([.. ToPoints(coordinates).Select(p => new Vector(p.X, p.Y, 0))]);
        Assert.Equal(usual, Triangulate([.. ToPoints(coordinates).Select(p => size * new Vector(p.X, p.Y, 0))]));
    }

    [Fact]
    public void Triangulate_IntoAListInUse_Appends()
    {
        List<int> triangles = [7];
        new PolygonTriangulator().Triangulate([Vector.Zero, Vector.I, Vector.J], triangles);
        Assert.Equal(4, triangles.Count);
        Assert.Equal(7, triangles[0]);
    }

    private static void AssertCovered(Random random, (double X, double Y)[] corners, bool isReversed)
    {
        (double X, double Y)[] polygon = isReversed ? [.. corners.Reverse()] : corners;
        var axes = random.Degrees().LocalAxesFromDegrees();
        var origin = random.Vector(10);
        var triangles = Triangulate([.. polygon.Select(p => origin + (axes * new Vector(p.X, p.Y, 0)))]);
        Assert.Equal(polygon.Length - 2, triangles.Count);
        var area = Enumerable.Range(0, polygon.Length).Sum(i => Cross(polygon[i], polygon[(i + 1) % polygon.Length])) / 2;
        var measured = triangles.Select(t => (Area: Area(polygon, t), Centre: Centre(polygon, t))).ToList();
        // The rounding of some dozens of areas up to a hundred.
        Near.Equal(area, measured.Sum(triangle => triangle.Area), 1e-12);
        Assert.All(measured, triangle =>
        {
            Assert.True(triangle.Area * Math.Sign(area) >= -1e-12, "a triangle is wound against the polygon");
            // A triangle without area, which collinear corners need, may have its centre on the border.
            Assert.True(Math.Abs(triangle.Area) < 1e-9 || IsInside(polygon, triangle.Centre), "a triangle lies outside");
        });
    }

    private static List<int[]> Triangulate(Vector[] corners)
    {
        List<int> triangles = [];
        new PolygonTriangulator().Triangulate(corners, triangles);
        return [.. triangles.Chunk(3)];
    }

    private static (double X, double Y)[] ToPoints(double[] coordinates) => [.. coordinates.Chunk(2).Select(pair => (pair[0], pair[1]))];

    private static double Cross((double X, double Y) a, (double X, double Y) b) => (a.X * b.Y) - (a.Y * b.X);

    private static double Area((double X, double Y)[] polygon, int[] t) =>
        (Cross(polygon[t[0]], polygon[t[1]]) + Cross(polygon[t[1]], polygon[t[2]]) + Cross(polygon[t[2]], polygon[t[0]])) / 2;

    private static (double X, double Y) Centre((double X, double Y)[] polygon, int[] t) =>
        (t.Average(i => polygon[i].X), t.Average(i => polygon[i].Y));

    // A ray to the right crosses the border an odd number of times.
    private static bool IsInside((double X, double Y)[] polygon, (double X, double Y) p) => Enumerable.Range(0, polygon.Length)
        .Select(i => (A: polygon[i], B: polygon[(i + 1) % polygon.Length]))
        .Count(edge => edge.A.Y > p.Y != edge.B.Y > p.Y
            && p.X < edge.A.X + ((p.Y - edge.A.Y) / (edge.B.Y - edge.A.Y) * (edge.B.X - edge.A.X))) % 2 == 1;
}
