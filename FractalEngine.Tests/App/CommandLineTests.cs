using System.Text.Json;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.App;

/// <summary>
/// Tests outputs and exit codes of the commands that need no display. Each command runs as a process; more of them are in
/// <see cref="CommandResultTests"/>.
/// </summary>
public sealed class CommandLineTests : IDisposable
{
    private readonly TemporaryFolder _folder = new();

    public CommandLineTests()
    {
        _folder.Write("cube.obj", SampleFiles.Cube);
        _folder.Write("row.fdo", SampleFiles.Row("3"));
    }

    public void Dispose() => _folder.Dispose();

    [Fact]
    public void Info_OfFractal_CountsExactly()
    {
        var (exitCode, output, error) = Run("info", "row.fdo", "--json");
        Assert.Equal((0, ""), (exitCode, error));
        using var info = JsonDocument.Parse(output);
        Assert.Equal("fractal", info.RootElement.GetProperty("kind").GetString());
        Assert.Equal(64, info.RootElement.GetProperty("vertices").GetInt32());
        Assert.Equal(96, info.RootElement.GetProperty("faces").GetInt32());
        Assert.Equal(8, info.RootElement.GetProperty("instances").GetInt32());
        Assert.Equal(8, info.RootElement.GetProperty("chains").GetInt32());
        Assert.Equal(new FileInfo(_folder["row.fdo"]).Length + new FileInfo(_folder["cube.obj"]).Length,
            info.RootElement.GetProperty("storageBytes").GetInt64());
        Assert.Equal([-0.5, -0.0625, -0.0625], info.RootElement.GetProperty("boundsMin").EnumerateArray()
            .Select(number => number.GetDouble()));
        Assert.Equal([0.5, 0.0625, 0.0625], info.RootElement.GetProperty("boundsMax").EnumerateArray()
            .Select(number => number.GetDouble()));
        // However fast or busy the machine is, loading takes some time.
        Assert.True(info.RootElement.GetProperty("loadMilliseconds").GetDouble() > 0);
        Assert.Equal(JsonValueKind.Null, info.RootElement.GetProperty("prepareMilliseconds").ValueKind);
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
    public void Info_OfDepthOneMillion_WritesEveryDigit()
    {
        _folder.Write("deep.fdo", SampleFiles.Row("1000000"));
        var (exitCode, output, _) = Run("info", "deep.fdo");
        Assert.Equal(0, exitCode);
        // 2^1000000 has 301,030 digits, the first and last of which are known (OEIS A000079).
        var digits = output.Split('\n').First(line => line.StartsWith("instances", StringComparison.Ordinal))[18..].Trim();
        Assert.Equal(301_030, digits.Length);
        Assert.StartsWith("99006562292958982506979236163", digits, StringComparison.Ordinal);
        Assert.EndsWith("747109376", digits, StringComparison.Ordinal);
    }

    [Fact]
    public void Count_OfMesh_WritesHeaderOnce()
    {
        Assert.Equal(new AppResult(0, $"12{Environment.NewLine}", ""), Run("count", "cube.obj"));
        Assert.Equal("# Mesh count: 12\n" + SampleFiles.Cube, File.ReadAllText(_folder["cube.obj"]));
        Assert.Equal(0, Run("count", "cube.obj").ExitCode);
        Assert.Equal("# Mesh count: 12\n" + SampleFiles.Cube, File.ReadAllText(_folder["cube.obj"]));
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
    public void Check_OfAGoodFile_SaysOk() =>
        Assert.Equal(new AppResult(0, $"row.fdo: ok{Environment.NewLine}", ""), Run("check", "row.fdo"));

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

    [SkippableFact]
    public void Render_WithoutDisplay_ExitsWith4AndWritesNothing()
    {
        Elsewhere.SkipIf(!OperatingSystem.IsLinux(), "only X11 and Wayland find their display by variables of the environment");
        var noDisplay = new Dictionary<string, string?> { ["DISPLAY"] = null, ["WAYLAND_DISPLAY"] = null };
        var (exitCode, output, error) = AppProcess.Run(_folder.Path, noDisplay, "render", "cube.obj", "--output", "a.png");
        Assert.Equal((4, ""), (exitCode, output));
        // The system's own libraries may write lines of theirs.
        Assert.Matches("(?m)^error: [^\n]+$", error);
        Assert.DoesNotContain("   at ", error, StringComparison.Ordinal);
        Assert.False(File.Exists(_folder["a.png"]));
    }

    [Theory]
    [InlineData("de_DE.UTF-8")]
    [InlineData("tr_TR.UTF-8")]
    [InlineData("ar_SA.UTF-8")]
    public void Commands_InAnyCulture_WriteTheSame(string culture)
    {
        var environment = new Dictionary<string, string?> { ["LC_ALL"] = culture, ["LANG"] = culture };
        var flat = AppProcess.Run(_folder.Path, environment, "export", "row.fdo", "--output", "there.obj", "--quiet");
        Assert.Equal(new AppResult(0, "", ""), flat);
        Assert.Equal(new AppResult(0, "", ""), Run("export", "row.fdo", "--output", "here.obj", "--quiet"));
        Assert.Equal(File.ReadAllBytes(_folder["here.obj"]), File.ReadAllBytes(_folder["there.obj"]));
    }

    [Theory]
    [InlineData("--help")]
    [InlineData("render", "--version")]
    public void HelpOrVersion_OfAnyCommand_ExitsWith0(params string[] arguments)
    {
        var (exitCode, output, error) = Run(arguments);
        Assert.Equal((0, ""), (exitCode, error));
        Assert.NotEqual("", output);
    }

    [Theory]
    [InlineData("--version")]
    [InlineData("render", "--help")]
    [Trait("Category", "Soak")]
    public void HelpOrVersion_OfAnyCommandInOtherCases_ExitsWith0(params string[] arguments) =>
        HelpOrVersion_OfAnyCommand_ExitsWith0(arguments);

    [Fact]
    public void Query_OnAnyNumberOfCores_PrintsTheSameLinesInTheOrderOfThePoints()
    {
        // Several blocks for each thread, among more objects than are searched without a hierarchy.
        _folder.Write("many.sdo", string.Concat(Enumerable.Range(0, 100).Select(i => $"o \"cube.obj\" (({3 * i}, 0, 0), #, #)\n")));
        _folder.Write("points.txt", string.Concat(Enumerable.Range(0, 3000).Select(i => $"{i % 300} {i / 300} 2\n")));
        string[] arguments = ["query", "many.sdo", "--points", "points.txt"];
        var (_, expected, _) = AppProcess.Run(_folder.Path, new() { ["DOTNET_PROCESSOR_COUNT"] = "1" }, arguments);
        Assert.Equal(3000, expected.Count(character => character == '\n'));
        // The first point is 1.5 before the first cube.
        Assert.StartsWith("1.5 0 0 0.5 0 0 1 ", expected, StringComparison.Ordinal);
        Assert.Equal(expected, AppProcess.Run(_folder.Path, new() { ["DOTNET_PROCESSOR_COUNT"] = "4" }, arguments).Output);
    }

    private AppResult Run(params string[] arguments) => AppProcess.Run(_folder.Path, arguments);
}
