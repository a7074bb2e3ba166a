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
    public void Check_OfAGoodFile_SaysOk() =>
        Assert.Equal(new AppResult(0, $"row.fdo: ok{Environment.NewLine}", ""), Run("check", "row.fdo"));

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
