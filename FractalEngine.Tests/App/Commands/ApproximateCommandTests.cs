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
            + @"vertices are within \d\.\de-\d+ of the diagonal, surfaces within \d\.\de-\d+\n$", output);
        Assert.StartsWith("wrote out/found.fdo: ", error, StringComparison.Ordinal);
        Assert.Equal(["found-base.obj", "found.fdo"], Directory.GetFiles(_folder["out"]).Select(Path.GetFileName).Order());
        var text = File.ReadAllLines(_folder["out/found.fdo"]);
        Assert.Equal("# flat.obj as a fractal: EXACT: 12 of 4116 faces are left, with 7 maps", text[0]);
        Assert.Equal("m1. ((1/3, 0, 0), #, (1/3))", text[2]);
        Assert.Equal(["level1<inner1>. [m1., m2., m3., m4., m5., m6., m7.] inner1", "<$>. level1 3"], text[^2..]);
        // What is found is a file like any other.
        Assert.Contains("4116", Run("info", "out/found.fdo").Output, StringComparison.Ordinal);
    }

    [Fact]
    public void Approximate_OfAFileWithTheNameOfTheBase_LeavesItAlone()
    {
        Assert.Equal(0, Run("export", Repository.Full("assets/classics/vicsek.fdo"), "--output", "found-base.obj", "--quiet").ExitCode);
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
        Assert.StartsWith("REPEATS: 12 of 360 faces are left, with 2 maps\n", output, StringComparison.Ordinal);
        Assert.Contains("^0..29]", File.ReadAllText(_folder["found.fdo"]), StringComparison.Ordinal);
    }

    [Fact]
    public void Approximate_OfAPebble_FindsNoFractalAndWritesNothing()
    {
        var (exitCode, output, error) = Run("approximate", Repository.Full("assets/models/pebble.obj"), "--output", "found.fdo");
        Assert.Equal((6, "NO FRACTAL: nothing that makes all 80 faces was found\n", ""), (exitCode, output, error));
        Assert.False(File.Exists(_folder["found.fdo"]));
    }

    [Fact]
    public void Approximate_AfterItsTime_SaysSo()
    {
        var (exitCode, _, error) = Run(
            "approximate", Repository.Full("assets/fractals/menger-3.fdo"), "--output", "found.fdo", "--seconds", "0.001");
        Assert.Equal((6, "note: the search ended after 0.001 s, as --seconds says\n"), (exitCode, error));
    }

    [Theory]
    [InlineData(2, "error: a fractal has several files, so --output can't be '-'\n", "one.fdo", "--output", "-")]
    [InlineData(2, "error: empty.obj has no faces, so there is nothing to approximate\n", "empty.obj", "--output", "x.fdo")]
    [InlineData(3, null, "million.fdo", "--output", "x.fdo")]
    public void Approximate_OfWhatCannotBe_SaysWhy(int code, string? message, params string[] arguments)
    {
        _folder.Write("one.fdo", "<$>. ball\n");
        _folder.Write("empty.obj", "v 0 0 0\n");
        _folder.Write("million.fdo", "m. ((1, 0, 0), #, #)\n<$>. [m.^0..999] [((0, 1, 0), #, #)^0..999] box\n");
        var (exitCode, output, error) = Run(["approximate", .. arguments]);
        Assert.Equal((code, ""), (exitCode, output));
        Assert.EndsWith(message ?? error, error, StringComparison.Ordinal);
        Assert.False(File.Exists(_folder["x.fdo"]));
    }

    private AppResult Run(params string[] arguments) => AppInProcess.Run(_folder.Path, arguments);
}
