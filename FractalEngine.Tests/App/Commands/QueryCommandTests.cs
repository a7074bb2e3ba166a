using System.Globalization;
using System.Text.Json;
using FractalEngine.Core.Maths;
using FractalEngine.Tests.Support;
using static System.FormattableString;

namespace FractalEngine.Tests.App.Commands;

/// <summary>Tests the command <c>query</c>, which prints one line per position in order, or one error.</summary>
[Collection(ConsoleTests.Name)]
public sealed class QueryCommandTests : IDisposable
{
    private readonly TemporaryFolder _folder = new();

    public QueryCommandTests()
    {
        _folder.Write("cube.obj", SampleFiles.Cube);
        _folder.Write("row.fdo", SampleFiles.Row("1000000"));
        _folder.Write("scene.sdo", "o \"cube.obj\" ((0, 0, 0), #, (2, 2, 2))\no \"cube.obj\" ((10, 0, 0), #, #)\n");
    }

    public void Dispose() => _folder.Dispose();

    [Theory]
    [InlineData("exact")]
    [InlineData("hierarchy")]
    [InlineData("simple")]
    public void Query_OfACube_GivesDistancePointAndNormal(string collider)
    {
        _folder.Write("points.txt", "# two points\n2 0.25 0.125\n\n0, 0.125, -1 # below\n");
        var (exitCode, output, error) = Run("query", "cube.obj", "--points", "points.txt", "--collider", collider);
        Assert.Equal(0, exitCode);
        var lines = output.Split('\n', StringSplitOptions.RemoveEmptyEntries);
        Assert.Equal(2, lines.Length);
        Assert.StartsWith("1.5 0.5 0.25 0.125 1 0 0 ", lines[0], StringComparison.Ordinal);
        Assert.StartsWith("0.5 0 0.125 -0.5 0 0 -1 ", lines[1].Replace("-0 ", "0 ", StringComparison.Ordinal), StringComparison.Ordinal);
        Assert.StartsWith("faces 12\nbuild ", error, StringComparison.Ordinal);
    }

    [Fact]
    public void Query_WithMaxDistance_SaysNone()
    {
        _folder.Write("points.txt", "3 0 0\n1 0 0\n");
        var lines = Run("query", "cube.obj", "--points", "points.txt", "--within", "1").Output.Split('\n');
        Assert.Equal("none", lines[0]);
        Assert.StartsWith("0.5 ", lines[1], StringComparison.Ordinal);
    }

    [Theory]
    [InlineData("exact", 0, 1e-13)]
    [InlineData("bounding-box", 1.5, 1.5)]
    public void Query_WithErrorBound_PrintsANinthColumn(string collider, double minimum, double maximum)
    {
        _folder.Write("points.txt", "2 0.25 0.125\n");
        var (exitCode, output, _) = Run("query", "cube.obj", "--points", "points.txt", "--collider", collider, "--error-bound");
        Assert.Equal(0, exitCode);
        var columns = output.TrimEnd().Split(' ');
        Assert.Equal(9, columns.Length);
        Assert.InRange(double.Parse(columns[8], CultureInfo.InvariantCulture), minimum, maximum);
        var json = Run("query", "cube.obj", "--points", "points.txt", "--collider", collider, "--error-bound", "--json").Output;
        using var results = JsonDocument.Parse(json);
        Assert.InRange(results.RootElement[0].GetProperty("errorBound").GetDouble(), minimum, maximum);
    }

    /// <summary>An expanded fractal is one mesh, whose faces don't tell which base mesh they are of.</summary>
    [Theory]
    [InlineData("exact", 2, "tetrahedron")]
    [InlineData("hierarchy", 14, null)]
    [InlineData("simple", 14, null)]
    public void Query_OfSeveralMeshes_NamesThatOfTheFace(string collider, int face, string? mesh)
    {
        _folder.Write("two.fdo", "<$>. box + [((6, 0, 0), #, #)] tetrahedron\n");
        _folder.Write("points.txt", "6 -1 0\n");
        using var results = JsonDocument.Parse(
            Run("query", "two.fdo", "--points", "points.txt", "--json", "--collider", collider).Output);
        Assert.Equal(face, results.RootElement[0].GetProperty("face").GetInt32());
        Assert.Equal(mesh, results.RootElement[0].TryGetProperty("mesh", out var name) ? name.GetString() : null);
    }

    [Fact]
    public void Query_OfADeepFractal_IsAccurate()
    {
        _folder.Write("points.txt", "0.1 2 0\n");
        var (exitCode, output, _) = Run("query", "row.fdo", "--points", "points.txt", "--json");
        Assert.Equal(0, exitCode);
        using var results = JsonDocument.Parse(output);
        // The row is only 2⁻¹⁰⁰⁰⁰⁰⁰ thick, so its distance is 2 to the last digits of the coordinates.
        Assert.Equal(2, results.RootElement[0].GetProperty("distance").GetDouble(), 1e-14);
    }

    [Fact]
    public void Query_OfRays_PrintsWhatEachHits()
    {
        _folder.Write("rays.txt", "# through the cube, past it\n0.25 0.125 -3  0 0 2\n5 5 -3, 0 0 1\n");
        var (exitCode, output, error) = Run("query", "cube.obj", "--rays", "rays.txt", "--header");
        Assert.Equal(0, exitCode);
        Assert.Matches(
            "^distance x y z nx ny nz face\n2.5 0.25 0.125 -0.5 -?0 -?0 -1 [0-9]+\nnone\n$", output);
        Assert.Matches("^rays [0-9]+ a second\nface tests [0-9.]+ a ray\nbound tests [0-9.]+ a ray\n$", error);
    }

    /// <summary>Bounds of a base mesh in a plane beside the origin have no thickness, and must hold their rays by rounding.</summary>
    [Theory]
    [InlineData(1, 6, 2)]
    public void Query_OfRaysAimedAtAFlatBase_HitsAsItsExportDoes(int seed, int mapCount, int depth) =>
        CheckFlatBase(seed, mapCount, depth);

    [Theory]
    [InlineData(5, 7, 4)]
    [Trait("Category", "Soak")]
    public void Query_OfRaysAimedAtAFlatBaseInOtherCases_HitsAsItsExportDoes(int seed, int mapCount, int depth) =>
        Query_OfRaysAimedAtAFlatBase_HitsAsItsExportDoes(seed, mapCount, depth);

    [Theory]
    [InlineData(2, 4, 5)]
    [InlineData(3, 8, 2)]
    [InlineData(4, 5, 3)]
    [InlineData(6, 8, 3)]
    [Trait("Category", "Soak")]
    public void Query_OfRaysAimedAtOtherFlatBases_HitsAsTheirExportsDo(int seed, int mapCount, int depth) =>
        CheckFlatBase(seed, mapCount, depth);

    private void CheckFlatBase(int seed, int mapCount, int depth)
    {
        var random = new Random(seed);
        Vector[] moves = [.. Enumerable.Range(0, mapCount).Select(_ => 2 * random.Vector())];
        var maps = Enumerable.Range(1, mapCount).Select(i => $"t.{i}.{mapCount + 1}");
        _folder.Write("flat.obj", "v 0.1 0.7 -0.2\nv 1 0.7 0.3\nv -0.3 0.7 0.9\nf 1 2 3\n");
        _folder.Write("flat.fdo", $"{string.Concat(moves.Append(0.6 * Vector.One).Select(v => Invariant($"v {v.X:R} {v.Y:R} {v.Z:R}\n")))}"
            + $"x. \"flat.obj\"\nt.a.b. (a, #, b)\nz<x>. [{string.Join(", ", maps)}] x\n<$>. z {depth}\n");
        _folder.Write("rays.txt", string.Concat(Enumerable.Range(0, 457).Select(_ => DrawRay())));
        Assert.Equal(0, Run("export", "flat.fdo", "--output", "all.obj").ExitCode);
        var expected = Distances("all.obj");
        var actual = Distances("flat.fdo");
        Assert.Equal(457, expected.Length);
        for (var i = 0; i < expected.Length; i++)
        {
            // Coordinates of some units, printed with all digits, and rays that cross the plane at a sine of at least 0.07.
            Assert.True(Math.Abs(actual[i] - expected[i]) <= 1e-13, $"seed {seed}, ray {i}: {actual[i]:R} for {expected[i]:R}");
        }

        // None misses what it is aimed at, so a distance that is no number is a failure.
        double[] Distances(string file) =>
        [
            .. Run("query", file, "--rays", "rays.txt").Output.Split('\n', StringSplitOptions.RemoveEmptyEntries)
                .Select(line => line == "none" ? double.NaN : double.Parse(line.Split(' ')[0], CultureInfo.InvariantCulture)),
        ];

        string DrawRay()
        {
            var (u, v) = random.Barycentrics();
            var point = new Vector(0.1 + (0.9 * u) - (0.4 * v), 0.7, -0.2 + (0.5 * u) + (1.1 * v));
            for (var level = 0; level < depth; level++)
            {
                point = moves[random.Next(mapCount)] + (0.6 * point);
            }

            var rise = (random.Next(2) == 0 ? 1 : -1) * random.Between(0.1, 1);
            var direction = new Vector(random.Between(-1, 1), rise, random.Between(-1, 1));
            var (x, y, z) = point - (random.Between(0.5, 4) * direction);
            return Invariant($"{x:R} {y:R} {z:R} {direction.X:R} {direction.Y:R} {direction.Z:R}\n");
        }
    }

    [Fact]
    public void Query_OfRaysAsJson_NamesObjectAndInstance()
    {
        _folder.Write("row3.fdo", SampleFiles.Row("3"));
        _folder.Write("two.sdo", "o \"cube.obj\" ((0, 9, 0), #, #)\no \"row3.fdo\" ((0, 0, 0), #, #)\n");
        _folder.Write("rays.txt", "0.45 0 -3 0 0 1\n0 5 -3 0 0 1\n");
        var (exitCode, output, _) = Run("query", "two.sdo", "--rays", "rays.txt", "--json");
        Assert.Equal(0, exitCode);
        using var results = JsonDocument.Parse(output);
        var hit = results.RootElement[0];
        Assert.Equal((1, 3), (hit.GetProperty("object").GetInt32(), hit.GetProperty("instance").GetArrayLength()));
        Assert.Equal(3 - 0.0625, hit.GetProperty("distance").GetDouble(), 1e-12);
        Assert.True(hit.GetProperty("front").GetBoolean());
        Assert.Equal(1, hit.GetProperty("barycentrics").EnumerateArray().Sum(weight => weight.GetDouble()), 1e-12);
        Assert.Equal(JsonValueKind.Null, results.RootElement[1].ValueKind);
    }

    [Fact]
    public void Query_OfPointsAsJson_NamesObjectAndFace()
    {
        _folder.Write("row3.fdo", SampleFiles.Row("3"));
        _folder.Write("two.sdo", "o \"cube.obj\" ((0, 9, 0), #, #)\no \"row3.fdo\" ((0, 0, 0), #, #)\n");
        _folder.Write("points.txt", "0 20 0\n0 -3 0\n");
        var (exitCode, output, _) = Run("query", "two.sdo", "--points", "points.txt", "--json");
        Assert.Equal(0, exitCode);
        using var results = JsonDocument.Parse(output);
        Assert.Equal([0, 1], results.RootElement.EnumerateArray().Select(result => result.GetProperty("object").GetInt32()));
        Assert.All(results.RootElement.EnumerateArray(), result => Assert.InRange(result.GetProperty("face").GetInt32(), 0, 11));
    }

    [Fact]
    public void Query_OfAWrongRay_NamesItsPlace()
    {
        _folder.Write("rays.txt", "0 0 0 0 0 1\n1 2 3 0 0 0\n");
        var (exitCode, output, error) = Run("query", "cube.obj", "--rays", "rays.txt");
        Assert.Equal((1, ""), (exitCode, output));
        Assert.StartsWith("rays.txt:2:7: error: a direction of length 0\n", error, StringComparison.Ordinal);
    }

    [Fact]
    public void Query_OfAScene_IsInWorldSpace()
    {
        _folder.Write("points.txt", "0 3 0\n10 3 0\n");
        var lines = Run("query", "scene.sdo", "--points", "points.txt").Output.Split('\n');
        Assert.StartsWith("2 0 1 0 0 1 0 ", lines[0], StringComparison.Ordinal);
        Assert.StartsWith("2.5 10 0.5 0 0 1 0 ", lines[1], StringComparison.Ordinal);
    }

    [Fact]
    public void Query_OfBadPoints_NamesTheLine()
    {
        _folder.Write("points.txt", "1 2 3\n4 5\n");
        Assert.Equal(
            new AppResult(
                1, "",
                "points.txt:2:4: error: unexpected end of line: a vector has three numbers, and this one has two\n  4 5\n     ^\n"),
            Run("query", "cube.obj", "--points", "points.txt"));
    }

    [Theory]
    [InlineData("--collider", "fractal")]
    [InlineData("--collider", "magic")]
    [InlineData("--within", "-1")]
    [InlineData("--epsilon", "NaN")]
    public void Query_WithInvalidOptions_IsWrongUsage(params string[] options)
    {
        _folder.Write("points.txt", "1 2 3\n");
        var (exitCode, output, error) = Run(["query", "cube.obj", "--points", "points.txt", .. options]);
        Assert.Equal((2, ""), (exitCode, output));
        Assert.StartsWith("error: ", error, StringComparison.Ordinal);
    }

    private AppResult Run(params string[] arguments) => AppInProcess.Run(_folder.Path, arguments);
}
