using System.Globalization;
using System.Text;
using System.Text.Json;
using FractalEngine.Core.Fractals;
using FractalEngine.Parsing;
using FractalEngine.Render.Images;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.App.Commands;

/// <summary>Tests what <c>approximate</c> says, writes, and leaves alone.</summary>
[Collection(ConsoleTests.Name)]
public sealed class ApproximateCommandTests : IDisposable
{
    private readonly TemporaryFolder _folder = new();

    public void Dispose() => _folder.Dispose();

    [Fact]
    public void Approximate_OfAnExpandedFractal_WritesItsText()
    {
        var classic = Repository.Full("assets/classics/vicsek.fdo");
        Assert.Equal(0, Run("export", classic, "--output", "flat.obj", "--quiet").ExitCode);
        var (exitCode, output, error) = Run("approximate", "flat.obj", "--output", "out/found.fdo");
        Assert.Equal(0, exitCode);
        Assert.Matches(
            @"^EXACT: 12 of 4116 faces are left, with 7 maps\n"
            + @"vertices are within \d\.\de[-+]\d+ of the diagonal, surfaces within \d\.\de-\d+\n$", output);
        Assert.StartsWith("wrote out/found.fdo: ", error, StringComparison.Ordinal);
        Assert.Equal(["found.fdo"], Directory.GetFiles(_folder["out"]).Select(Path.GetFileName));
        var text = File.ReadAllLines(_folder["out/found.fdo"]);
        Assert.Equal("# flat.obj as a fractal: EXACT: 12 of 4116 faces are left, with 7 maps", text[0]);
        Assert.Equal("m1. ((0, 1/3, 0), #, (1/3))", text[2]);
        Assert.Equal(["level1<inner1>. [m1., m2., m3., m4., m5., m6., m7.] inner1", "<$>. level1 3"], text[^2..]);
        // What is found is a file like any other.
        Assert.Contains("4116", Run("info", "out/found.fdo").Output, StringComparison.Ordinal);
    }

    [Fact]
    public void Approximate_OfAFileWithTheNameOfTheBase_LeavesItAlone()
    {
        var triangle = Repository.Full("assets/fractals/sierpinski.fdo");
        Assert.Equal(0, Run("export", triangle, "--depth", "2", "--output", "found-base.obj", "--quiet").ExitCode);
        var before = File.ReadAllText(_folder["found-base.obj"]);
        Assert.Equal(0, Run("approximate", "found-base.obj", "--output", "found.fdo", "--quiet").ExitCode);
        Assert.Equal(before, File.ReadAllText(_folder["found-base.obj"]));
        Assert.Contains("base. \"found-base-2.obj\"", File.ReadAllText(_folder["found.fdo"]), StringComparison.Ordinal);
    }

    [Fact]
    public void Approximate_BesideAnUnusedVertexFarOff_IsNoLessExact()
    {
        _folder.Write("two.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 5 0 0\nv 6 0 0\nv 5 2 0\nv 1e14 0 0\nf 1 2 3\nf 4 5 6\n");
        Assert.Equal(0, Run("approximate", "two.obj", "--output", "two.fdo", "--quiet").ExitCode);
        Run("export", "two.fdo", "--output", "back.obj", "--quiet");
        Assert.Contains("v 5 2 0", File.ReadAllText(_folder["back.obj"]), StringComparison.Ordinal);
    }

    [Fact]
    public void Approximate_OfARow_SaysThatItRepeats()
    {
        _folder.Write("row.fdo", "m. ((1, 0.25, 0), (0, 5, 0), #)\n<$>. [m.^0..29] box\n");
        var (exitCode, output, _) = Run("approximate", "row.fdo", "--output", "found.fdo", "--quiet");
        Assert.Equal(0, exitCode);
        Assert.StartsWith("REPEATS: 12 of 360 faces are left, with 1 map\n", output, StringComparison.Ordinal);
        Assert.Contains("^0..29]", File.ReadAllText(_folder["found.fdo"]), StringComparison.Ordinal);
    }

    [Fact]
    public void Approximate_OfOneElement_SaysThatTheMeshIsBest()
    {
        _folder.Write("one.obj", "v 0 0 0\nv 3 0 0\nv 3.5 1 0\nv 0 2 0\nv 0.3 0.6 1\nf 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\n");
        var (exitCode, output, _) = Run("approximate", "one.obj", "--output", "found.fdo", "--report", "found.json");
        Assert.Equal(6, exitCode);
        Assert.Matches(
            @"^NO FRACTAL: nothing is closer than the simplified mesh of 4 faces, \d+ bytes\n"
            + @"mean distance 0.00000 of the diagonal, largest 0.0000 to 0.0000, normals 0.0° apart\n$", output);
        Assert.EndsWith("base. \"found-base.obj\"\n<$>. base\n", File.ReadAllText(_folder["found.fdo"]), StringComparison.Ordinal);
        using var report = JsonDocument.Parse(File.ReadAllText(_folder["found.json"]));
        Assert.Equal("no fractal", report.RootElement.GetProperty("verdict").GetString());
        Assert.Equal("search", report.RootElement.GetProperty("endedBy").GetString());
        Assert.Equal(4, report.RootElement.GetProperty("facesMade").GetInt32());
    }

    [Fact]
    public void Approximate_OfAMirroredShape_IsCloserThanASimplifiedMeshOfAsManyBytes()
    {
        // Bumps whose heights are nearly the same on both sides.
        var shape = new StringBuilder();
        for (var row = 0; row <= 60; row++)
        {
            for (var column = -30; column <= 30; column++)
            {
                var height = Math.Sin(0.4 * Math.Abs(column)) * Math.Cos(0.3 * row) + (column > 0 ? 1e-3 * Math.Sin(row * column) : 0);
                shape.Append(CultureInfo.InvariantCulture, $"v {0.1 * column} {0.1 * row} {height}\n");
            }
        }

        for (var cell = 0; cell < 3600; cell++)
        {
            var first = (cell / 60 * 61) + (cell % 60) + 1;
            shape.Append(CultureInfo.InvariantCulture, $"f {first} {first + 1} {first + 62} {first + 61}\n");
        }

        _folder.Write("bumps.obj", shape.ToString());
        var (exitCode, output, _) = Run("approximate", "bumps.obj", "--output", "found.fdo", "--bytes", "3000", "--report", "found.json");
        Assert.Equal(0, exitCode);
        Assert.Matches("^APPROXIMATE: [0-9]+ of 7200 faces are left, with 1 map, [0-9]+ bytes\n", output);
        var files = new DirectoryInfo(_folder.Path).GetFiles("found*.*").Where(file => file.Extension != ".json");
        Assert.InRange(files.Sum(file => file.Length), 2000, 3000 + 400);
        using var report = JsonDocument.Parse(File.ReadAllText(_folder["found.json"]));
        var mean = report.RootElement.GetProperty("distance").GetProperty("mean").GetDouble();
        var simple = report.RootElement.GetProperty("sameBytesMesh").GetProperty("distance").GetProperty("mean").GetDouble();
        Assert.InRange(mean, 1e-5, 0.8 * simple);
        Assert.Contains("m1. (#, #, (-1, 1, 1))", File.ReadAllText(_folder["found.fdo"]), StringComparison.Ordinal);
    }

    [Fact]
    public void Approximate_WithFewerMapsThanItNeeds_IsNotExact()
    {
        Run("export", Repository.Full("assets/classics/vicsek.fdo"), "--depth", "2", "--output", "flat.obj", "--quiet");
        var (_, output, _) = Run("approximate", "flat.obj", "--output", "found.fdo", "--maps", "6", "--quiet");
        Assert.DoesNotContain("EXACT", output, StringComparison.Ordinal);
    }

    [Fact]
    public void Approximate_WithAnImage_ShowsMeshFractalAndDistance()
    {
        var image = Path.Combine(_folder.Path, "found.png");
        Assert.Equal(0, Run(
            "approximate", Repository.Full("assets/classics/vicsek.fdo"), "--output", "found.fdo", "--image", "found.png").ExitCode);
        var drawn = ImageFile.Load(image);
        Assert.Equal((2160, 720), (drawn.Width, drawn.Height));
        // The mesh and the fractal are the same; the distance is none, which is blue.
        var (red, _, blue, _) = drawn[1800, 360];
        Assert.True(blue > red, $"{red}, {blue}");
        Assert.Equal(drawn[360, 360], drawn[1080, 360]);
    }

    [Fact]
    public void Approximate_AfterItsTime_SaysSo()
    {
        var (exitCode, output, error) = Run(
            "approximate", Repository.Full("assets/fractals/menger-3.fdo"), "--output", "found.fdo", "--seconds", "0.001");
        Assert.Equal((6, "note: the search ended after 0.001 s, as --seconds says\n"), (exitCode, error));
        Assert.Equal("NO FRACTAL: nothing was found in that time, and nothing is written\n", output);
        Assert.False(File.Exists(_folder["found.fdo"]));
    }

    [Theory]
    [InlineData(2, "error: a fractal has several files, so --output can't be '-'\n", "one.fdo", "--output", "-")]
    [InlineData(2, "error: empty.obj has no faces, so there is nothing to approximate\n", "empty.obj", "--output", "x.fdo")]
    [InlineData(
        1, "nan.obj:2:5: error: unexpected 'nan', expected a number\n  v 1 nan 0\n      ^\n", "nan.obj", "--output", "x.fdo")]
    [InlineData(3, "error: the fractal has 1,000,000 instances, more than the limit of 250,000\n", "million.fdo", "--output", "x.fdo")]
    [InlineData(
        3, "error: soup.obj has more faces than the limit of 39\n", "soup.obj", "--output", "x.fdo", "--limit", "approximated-faces=39")]
    public void Approximate_OfWhatCannotBe_SaysWhy(int code, string message, params string[] arguments)
    {
        WriteSoup("soup.obj", step: 3);
        _folder.Write("nan.obj", "v 0 0 0\nv 1 nan 0\nv 0 1 0\nf 1 2 3\n");
        _folder.Write("one.fdo", "<$>. ball\n");
        _folder.Write("empty.obj", "v 0 0 0\n");
        _folder.Write("million.fdo", "m. ((1, 0, 0), #, #)\n<$>. [m.^0..999] [((0, 1, 0), #, #)^0..999] box\n");
        var (exitCode, output, error) = Run(["approximate", .. arguments]);
        Assert.Equal((code, ""), (exitCode, output));
        Assert.EndsWith(message, error, StringComparison.Ordinal);
        Assert.False(File.Exists(_folder["x.fdo"]));
    }

    [Theory]
    [InlineData(3)]
    [InlineData(1)]
    public void Approximate_OfSeparateOrIntersectingTriangles_WritesThemAsTheyAre(int step)
    {
        WriteSoup("soup.obj", step);
        var (exitCode, output, _) = Run("approximate", "soup.obj", "--output", "found.fdo", "--quiet");
        Assert.Equal(6, exitCode);
        Assert.StartsWith("NO FRACTAL: nothing is closer than the simplified mesh of 40 faces, ", output, StringComparison.Ordinal);
        Assert.Equal(40, FractalFile.Read(_folder["found.fdo"]).Flatten(40).FaceCount);
    }

    /// <summary>Writes forty triangles at random, which intersect each other; with a step of 1 each shares an edge with the next.</summary>
    private void WriteSoup(string name, int step)
    {
        var random = new Random(8);
        var text = new StringBuilder();
        for (var vertex = 0; vertex < (40 * step) + 2; vertex++)
        {
            text.Append(CultureInfo.InvariantCulture, $"v {random.Next(999)} {random.Next(999)} {random.Next(999)}\n");
        }

        for (var face = 0; face < 40; face++)
        {
            var first = (step * face) + 1;
            text.Append(CultureInfo.InvariantCulture, $"f {first} {first + 1} {first + 2}\n");
        }

        _folder.Write(name, text.ToString());
    }

    private AppResult Run(params string[] arguments) => AppInProcess.Run(_folder.Path, arguments);
}
