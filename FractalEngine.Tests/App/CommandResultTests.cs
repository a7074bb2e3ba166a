using System.Numerics;
using System.Text.Json;
using FractalEngine.Core;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.App;

/// <summary>Tests outputs and exit codes of the commands that need no display, in the process of the tests.</summary>
[Collection(ConsoleTests.Name)]
public sealed class CommandResultTests : IDisposable
{
    private readonly TemporaryFolder _folder = new();

    public CommandResultTests()
    {
        _folder.Write("cube.obj", SampleFiles.Cube);
        _folder.Write("row.fdo", SampleFiles.Row("3"));
    }

    public void Dispose() => _folder.Dispose();

    /// <summary>Behind two dashes there are files alone, whatever they are called.</summary>
    [Theory]
    [InlineData("info", "--json", "--", "-cube.obj")]
    [InlineData("check", "--", "-cube.obj", "--help.obj")]
    public void Files_BehindTwoDashes_MayBeginWithADash(params string[] arguments)
    {
        _folder.Write("-cube.obj", SampleFiles.Cube);
        _folder.Write("--help.obj", SampleFiles.Cube);
        var (exitCode, _, error) = Run(arguments);
        Assert.Equal((0, ""), (exitCode, error));
        Assert.Equal(2, Run("info", "-cube.obj").ExitCode);
    }

    /// <summary>A set without maps leaves nothing, however often it is repeated.</summary>
    [Fact]
    public void Commands_OnAnEmptyFractalWithoutEnd_FindNothing()
    {
        _folder.Write("empty.fdo", "x. \"cube.obj\"\nz<x>. [] x\n<$>. z\n");
        _folder.Write("points.txt", "0 0 5\n");
        var (exitCode, output, _) = Run("query", "empty.fdo", "--points", "points.txt");
        Assert.Equal((0, "none\n"), (exitCode, output));
        Assert.Equal((0, "wrote empty.obj: 0 faces"), Written(Run("export", "empty.fdo", "--output", "empty.obj")));
    }

    [Fact]
    public void Export_OfInstancesThatCoincide_StatesTheFacesOfTheFile()
    {
        _folder.Write("double.fdo", "v 0.5 0.5 0.5\nt.a. (a, #, #)\nx. \"cube.obj\"\nz<x>. [#, #] x\n<$>. z 5\n");
        Assert.Equal((0, "wrote double.obj: 12 faces"), Written(Run("export", "double.fdo", "--output", "double.obj")));
        Assert.StartsWith("# Mesh count: 12", File.ReadAllText(_folder["double.obj"]));
    }

    [Fact]
    public void Query_OfRaysBeyondTheirRange_ExitsWith3()
    {
        _folder.Write("rays.txt", "0 0 1e76 0 0 -1\n");
        var (exitCode, output, error) = Run("query", "cube.obj", "--rays", "rays.txt");
        Assert.Equal((3, ""), (exitCode, output));
        Assert.Contains("limit of 1E+75", error);
    }

    [Fact]
    public void Info_WithPrepare_MeasuresThatToo()
    {
        var (exitCode, output, _) = Run("info", "row.fdo", "--json", "--prepare");
        Assert.Equal(0, exitCode);
        using var info = JsonDocument.Parse(output);
        Assert.True(info.RootElement.GetProperty("prepareMilliseconds").GetDouble() > 0);
    }

    [Fact]
    public void Info_OfAGoogolInstances_WritesEveryDigit()
    {
        _folder.Write("googol.fdo", SampleFiles.Row("100")
            .Replace("[t.1, t.2]", $"[{string.Join(", ", Enumerable.Repeat("t.1", 10))}]", StringComparison.Ordinal));
        var (exitCode, output, _) = Run("info", "googol.fdo", "--json");
        Assert.Equal(0, exitCode);
        Assert.Contains($"\"chains\": {BigInteger.Pow(10, 100)},", output, StringComparison.Ordinal);
        // All chains repeat one map.
        Assert.Contains("\"instances\": 1,", output, StringComparison.Ordinal);
    }

    [Fact]
    public void Info_OfInfiniteFractal_SaysSo()
    {
        _folder.Write("infinite.fdo", SampleFiles.Row(""));
        var (exitCode, output, _) = Run("info", "infinite.fdo", "--json");
        Assert.Equal(0, exitCode);
        Assert.Contains("\"instances\": null, \"chains\": null, \"infinite\": true", output, StringComparison.Ordinal);
    }

    [Fact]
    public void Limits_AreListedWithTheirReasons()
    {
        var (exitCode, output, _) = Run("limits", "--limit", "depth=7");
        Assert.Equal(0, exitCode);
        Assert.Contains("depth                             7  repetitions of one recursive: exact counts stay printable", output,
            StringComparison.Ordinal);
    }

    [Theory]
    [InlineData(3, "depth=2")]
    [InlineData(0, "depth=3")]
    [InlineData(2, "depth")]
    [InlineData(2, "depth=0")]
    [InlineData(2, "nonsense=1")]
    public void Info_WithAnotherLimit_KeepsToIt(int exitCode, string limit) =>
        Assert.Equal(exitCode, Run("info", "row.fdo", "--limit", limit).ExitCode);

    [Theory]
    [InlineData("info", "far.sdo")]
    [InlineData("export", "far.sdo", "--output", "out.obj")]
    [InlineData("save", "far.sdo", "--output", "out.sdo")]
    public void AnyCommand_OnAPlacementBeyondADouble_NamesTheLimitAndWritesNothing(params string[] arguments)
    {
        _folder.Write("large.obj", "v 0 0 0\nv 1e308 0 0\nv 0 1e308 0\nf 1 2 3\n");
        _folder.Write("far.sdo", "o \"large.obj\" (#, #, (-10, 1, 1))\n");
        const string message = "far.sdo:1:3: error: the placement takes the object beyond 1.8e308, the limit of a coordinate\n"
            + "  o \"large.obj\" (#, #, (-10, 1, 1))\n    ^\n";
        Assert.Equal(new AppResult(3, "", message), Run(arguments));
        Assert.False(File.Exists(_folder["out.obj"]) || File.Exists(_folder["out.sdo"]));
    }

    [Theory]
    [InlineData("1e160 0 0", 3)]
    [InlineData("1e150 0 0", 0)]
    public void Query_OfAPointTooFarAway_IsRefused(string point, int exitCode)
    {
        _folder.Write("points.txt", point + "\n");
        Assert.Equal(exitCode, Run("query", "cube.obj", "--points", "points.txt", "--epsilon", "1e308").ExitCode);
    }

    [Fact]
    public void Simulate_OfManyBodiesAtOnePlace_IsRefused()
    {
        _folder.Write("bodies.sdo", string.Concat(Enumerable.Repeat("p \"cube.obj\" # 0.5\n", 201)));
        var (exitCode, _, error) = Run("simulate", "bodies.sdo", "--seconds", "1");
        Assert.Equal((3, "error: the bodies overlap each other in more than the limit of 20000 pairs"), (exitCode, error.Trim()));
    }

    [Fact]
    public void Query_OfAMeshTooFarAway_IsRefused()
    {
        _folder.Write("far.obj", "v 0 0 0\nv 1e160 0 0\nv 0 1e160 0\nf 1 2 3\n");
        _folder.Write("points.txt", "0 0 1\n");
        var (exitCode, _, error) = Run("query", "far.obj", "--points", "points.txt");
        Assert.Equal((3, "error: the scene reaches beyond the limit of 1E+150 for the coordinates of distances"), (exitCode, error.Trim()));
    }

    [Fact]
    public void Count_OfFractal_IsWrongUsage() => Assert.Equal(2, Run("count", "row.fdo").ExitCode);

    [Fact]
    public void Export_WithDepth_OverridesTheFile()
    {
        Assert.Equal(new AppResult(0, "", ""), Run("export", "row.fdo", "--output", "flat.obj", "--depth", "5", "--quiet"));
        Assert.Contains("\"faces\": 384,", Run("info", "flat.obj", "--json").Output, StringComparison.Ordinal);
    }

    [Fact]
    public void Export_IntoAMissingFolder_CreatesIt()
    {
        Assert.Equal(0, Run("export", "row.fdo", "--output", "a/b/flat.obj").ExitCode);
        Assert.True(File.Exists(_folder["a/b/flat.obj"]));
    }

    [Fact]
    public void Export_BeyondTheMaxDepth_ExitsWith3() =>
        Assert.Equal(3, Run("export", "row.fdo", "--output", "flat.obj", "--depth", "1000001").ExitCode);

    [Fact]
    public void Export_OfInfiniteFractal_ExitsWith3()
    {
        _folder.Write("infinite.fdo", SampleFiles.Row(""));
        Assert.Equal(3, Run("export", "infinite.fdo", "--output", "flat.obj").ExitCode);
        Assert.Equal(0, Run("export", "infinite.fdo", "--output", "flat.obj", "--depth", "2").ExitCode);
    }

    [Fact]
    public void Save_WithinTheFolder_KeepsEveryByte()
    {
        var text = "# mine\r\no \"row.fdo\"   #\r\n  # his\r\nc (1 2 3), # 60\r\n";
        _folder.Write("scene.sdo", text);
        Assert.Equal(new AppResult(0, "", ""), Run("save", "scene.sdo", "--output", "copy.sdo", "--quiet"));
        Assert.Equal(text, File.ReadAllText(_folder["copy.sdo"]));
    }

    [Fact]
    public void Check_OfAMeshWithoutItsMaterialFile_WarnsAndSaysOk()
    {
        _folder.Write("red.obj", "mtllib red.mtl\nusemtl red\n" + SampleFiles.Cube);
        Assert.Equal(
            new AppResult(0, $"red.obj: ok{Environment.NewLine}",
            "red.obj:1:8: warning: the file \"red.mtl\" is not found\n  mtllib red.mtl\n         ^\n"),
            Run("check", "red.obj"));
    }

    [Fact]
    public void Check_OfAFaultAndALimit_IsThatOfAFaultyFile()
    {
        _folder.Write("deep.fdo", SampleFiles.Row("99999999"));
        _folder.Write("both.sdo", "o \"deep.fdo\" #\no \"nope.obj\" #\n");
        Assert.Equal(3, Run("check", "deep.fdo").ExitCode);
        Assert.Equal(1, Run("check", "both.sdo").ExitCode);
    }

    [Fact]
    public void Check_OfAFolderWithoutModels_SaysSo()
    {
        Directory.CreateDirectory(_folder["empty"]);
        Assert.Equal(new AppResult(2, "", "error: the folder empty has no mesh, fractal or scene\n"), Run("check", "empty"));
    }

    [Fact]
    public void Check_OfACameraAcrossAllNumbers_Succeeds()
    {
        _folder.Write("far.sdo", "o \"cube.obj\" #\nc (1e308,0,0) look-at (-1e308,0,0) 60\n");
        Assert.Equal(0, Run("check", "far.sdo").ExitCode);
    }

    [Theory]
    [InlineData("\"a.obj")]
    [InlineData("a\".obj")]
    [InlineData("a\n.obj")]
    public void Save_OfAFileThatASceneCannotName_SaysSo(string name)
    {
        File.Copy(_folder["cube.obj"], _folder[name]);
        var (exitCode, _, error) = Run("save", name, "--output", "named.sdo");
        Assert.Equal(
            (2, $"error: {DisplayText.Escape(name)}: a scene can't refer to a file with a quote or a line break in its path"),
            (exitCode, error.Split('\n')[0]));
        Assert.False(File.Exists(_folder["named.sdo"]));
    }

    [Theory]
    [InlineData("missing.obj")]
    [InlineData("missing.sdo")]
    [InlineData(".")]
    [InlineData("notes.txt")]
    public void Info_OfAnUnreadableFile_ExitsWith1(string file)
    {
        _folder.Write("notes.txt", "hello\n");
        var (exitCode, output, error) = Run("info", file);
        Assert.Equal((1, ""), (exitCode, output));
        Assert.Matches(@"^\S+:1:1: error: [^\n]+\n$", error);
    }

    [Theory]
    [InlineData("--points")]
    [InlineData("--rays")]
    public void Query_OfTheStandardInputTwice_IsRefused(string list)
    {
        var (exitCode, _, error) = Run("query", "-", list, "-");
        Assert.Equal((2, "error: the standard input is named twice, and can be read once\n"), (exitCode, error));
    }

    [Fact]
    public void RenderTraced_OfTooManyPixels_NamesTheLimit()
    {
        string[] arguments = ["render", "cube.obj", "--trace", "1", "--resolution", "100000x100000", "--output", "out.png"];
        const string Problem = "error: a traced image of 100000×100000 pixels has more than the limit of ";

        Assert.Equal(new AppResult(3, "", Problem + "16777216 in all, which is 67108864 with --no-denoise\n"), Run(arguments));
        Assert.Equal(new AppResult(3, "", Problem + "67108864 in all\n"), Run([.. arguments, "--no-denoise"]));
    }

    [Fact]
    public void RenderTraced_OfPartsThatOverlapTooMuch_NamesTheLimitAndWritesNothing()
    {
        // Each ray enters up to 4^40 parts of nearly the same size: more than a minute for this image.
        _folder.Write("overlap.fdo", """
            v 0.3 0 0
            v 0.95 0.95 0.95
            v 10 10 20
            v 0 0 0.3
            v 0 0.3 0
            t.a.b.c. (a, c, b)
            x. "cube.obj"
            z<x>. [t.1.2.3, t.4.2.3, t.5.2.3, t.1.2.1] x
            <$>. z 40

            """);
        var (exitCode, output, error) =
            Run("render", "overlap.fdo", "--trace", "4", "--resolution", "64x48", "--output", "out.png");
        Assert.Equal(
            (3, "", "error: a path of light takes more than the limit of 10000 tests of bounds and faces (traced-tests): "
                + "too much of the scene overlaps\n"),
            (exitCode, output, error));
        Assert.False(File.Exists(_folder["out.png"]));
    }

    [Fact]
    public void Export_OverTheLimit_ExitsWith3AndWritesNothing()
    {
        var (exitCode, output, error) = Run("export", "row.fdo", "--output", "flat.obj", "--limit", "95");
        Assert.Equal((3, ""), (exitCode, output));
        Assert.StartsWith("error: ", error, StringComparison.Ordinal);
        Assert.Equal(["cube.obj", "row.fdo"], Directory.GetFiles(_folder.Path).Select(Path.GetFileName).Order());
    }

    [SkippableFact]
    public void Check_OfANamedPipe_DoesNotWait()
    {
        Elsewhere.SkipOnWindows("there are no named pipes");
        System.Diagnostics.Process.Start("mkfifo", _folder["pipe.obj"]).WaitForExit();
        Assert.Equal(new AppResult(1, "", "pipe.obj:1:1: error: this is a pipe or a device, expected a file\n"), Run("check", "pipe.obj"));
    }

    [Fact]
    public void Save_IntoAnotherFolder_NamesTheSameFiles()
    {
        _folder.Write("scene.sdo", "o \"row.fdo\" #\n");
        Directory.CreateDirectory(_folder["there"]);
        var (exitCode, _, error) = Run("save", "scene.sdo", "--output", "there/copy.sdo");
        Assert.Equal(0, exitCode);
        Assert.Contains("--allow-outside", error, StringComparison.Ordinal);
        Assert.Equal("o \"../row.fdo\" #\n", File.ReadAllText(_folder["there/copy.sdo"]));
        Assert.Equal(1, Run("check", "there/copy.sdo").ExitCode);
        Assert.Equal(0, Run("check", "there/copy.sdo", "--allow-outside").ExitCode);
    }

    [Fact]
    public void Check_OfABadBase_NamesTheReferringLine()
    {
        _folder.Write("bad.fdo", "x. \"nope.obj\"\n<$>. x\n");
        Assert.Equal(
            new AppResult(1, "", "bad.fdo:1:4: error: the file \"nope.obj\" is not found\n  x. \"nope.obj\"\n     ^\n"),
            Run("check", "bad.fdo"));
    }

    [Theory]
    [InlineData("frobnicate", "x.obj")]
    [InlineData("info")]
    [InlineData("export", "cube.obj", "--output", "cube.obj")]
    [InlineData("export", "row.fdo", "--output", "flat.obj", "--depth", "many")]
    [InlineData("render", "cube.obj", "--output", "a.png", "--trace", "1", "--wireframe")]
    [InlineData("render", "cube.obj", "--output", "a.png", "--resolution", "0x10")]
    public void Arguments_OfWrongUsage_ExitWith2AndAMessageOnStderr(params string[] arguments) => CheckWrongUsage(arguments);

    [Theory]
    [InlineData("info", "cube.obj", "--nonsense")]
    [InlineData("info", "")]
    [InlineData("--nonsense")]
    [InlineData("info", "--nonsense", "cube.obj")]
    [InlineData("export", "cube.obj")]
    [InlineData("export", "cube.obj", "--output", "flat.png")]
    [InlineData("export", "row.fdo", "--output", "flat.obj", "--depth", "-1")]
    [InlineData("export", "cube.obj", "--output", "flat.obj", "--depth", "2")]
    [InlineData("export", "cube.obj", "--output", "row.fdo/flat.obj")]
    [InlineData("export", "row.fdo", "--output", "cube.obj")]
    [InlineData("render", "cube.obj", "--output", "a.png", "--trace", "1", "--no-shadows")]
    [InlineData("query", "cube.obj", "--rays", "cube.obj", "--within", "1")]
    [InlineData("render", "cube.obj", "--output", "a.png", "--projection", "fisheye")]
    [InlineData("render", "cube.obj", "--output", "a.png", "--shading", "flat")]
    [Trait("Category", "Soak")]
    public void Arguments_OfOtherWrongUsage_ExitWith2AndAMessageOnStderr(params string[] arguments) => CheckWrongUsage(arguments);

    private void CheckWrongUsage(string[] arguments)
    {
        var (exitCode, output, error) = Run(arguments);
        Assert.Equal((2, ""), (exitCode, output));
        Assert.StartsWith("error: ", error, StringComparison.Ordinal);
        Assert.DoesNotContain("   at ", error, StringComparison.Ordinal);
    }

    [Fact]
    [Trait("Category", "Soak")]
    public void Render_TracingAModelBeyondALimit_ExitsWith3()
    {
        _folder.Write(
            "sums.fdo",
            "composition componentwise\nv 1.1 0 0\nv 0 1.2 0\nv 0 0 1.3\nv 1.01 0 0\nv 0 1.7 0\nt.a. (a, #, #)\n"
            + "x. \"cube.obj\"\nz<x>. [t.1, t.2, t.3, t.4, t.5] x\n<$>. z 1000\n");
        var (exitCode, _, error) = Run("render", "sums.fdo", "--output", "a.png", "--trace", "1", "--resolution", "16x16");
        Assert.Equal(3, exitCode);
        Assert.StartsWith("error: the sums of all levels are more than the limit", error, StringComparison.Ordinal);
    }

    [Theory]
    [InlineData(@"^wrote flat\.obj: 96 faces, [0-9.]+ kB, [0-9.]+ s\n$", "export", "row.fdo", "--output", "flat.obj")]
    [InlineData(@"^wrote copy\.sdo: 1 object, [0-9]+ bytes, [0-9.]+ s\n$", "save", "row.fdo", "--output", "copy.sdo")]
    [InlineData(@"^$", "export", "row.fdo", "--output", "flat.obj", "--quiet")]
    [InlineData(
        @"^load [0-9.]+ ms\nwrite [0-9.]+ ms\nwrote copy\.sdo: 1 object, [0-9]+ bytes, [0-9.]+ s\n$",
        "save", "row.fdo", "--output", "copy.sdo", "--verbose")]
    public void Output_WhenWritten_IsToldInOneLine(string report, params string[] arguments)
    {
        var (exitCode, output, error) = Run(arguments);
        Assert.Equal((0, ""), (exitCode, output));
        Assert.Matches(report, error);
    }

    [SkippableFact]
    public void Output_ThroughALink_IsToldWithTheSizeOfTheFile()
    {
        Elsewhere.SkipOnWindows("links need rights there");
        File.CreateSymbolicLink(_folder["link.obj"], "flat.obj");
        var (_, _, error) = Run("export", "cube.obj", "--output", "link.obj");
        Assert.Contains($": 12 faces, {new FileInfo(_folder["flat.obj"]).Length} bytes, ", error, StringComparison.Ordinal);
    }

    [SkippableFact]
    public void Messages_OfNamesWithLineBreaks_AreOneLine()
    {
        Elsewhere.SkipOnWindows("no name has line breaks there");
        Assert.Equal(new AppResult(1, "", "no\\u000Aname.fdo:1:1: error: file not found\n"), Run("info", "no\nname.fdo"));
        var (_, _, error) = Run("export", "cube.obj", "--output", "a\nb.obj");
        Assert.StartsWith("wrote a\\u000Ab.obj: 12 faces, ", error, StringComparison.Ordinal);
    }

    [Fact]
    public void Names_WithAnAtSign_AreNames() => Assert.Equal(
        new AppResult(1, "", "@cube.stl:1:1: error: file not found\n"), Run("info", "@cube.stl"));

    [Fact]
    public void Check_OfFilesAndFolders_ChecksEachAndTakesTheWorstCode()
    {
        _folder.Write("more/bad.fdo", "<$>. x\n");
        var (exitCode, output, error) = Run("check", "row.fdo", "more", "cube.obj");
        Assert.Equal((1, "row.fdo: ok\ncube.obj: ok\n"), (exitCode, output));
        Assert.StartsWith("more/bad.fdo:1:6: error: the object 'x' is not declared above\n", error, StringComparison.Ordinal);
    }

    private static (int ExitCode, string Text) Written(AppResult result) =>
        (result.ExitCode, string.Join(',', (result.Output + result.Error).Split(',')[..1]));

    private AppResult Run(params string[] arguments) => AppInProcess.Run(_folder.Path, arguments);
}
