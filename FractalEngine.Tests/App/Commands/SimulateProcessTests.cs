using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.App.Commands;

/// <summary>Tests what only processes of <c>simulate</c> have: a standard output, signals, a number of processors, and a culture.</summary>
public sealed class SimulateProcessTests : IDisposable
{
    private readonly TemporaryFolder _folder = new();

    public SimulateProcessTests() => SimulateCommandTests.WriteFiles(_folder);

    public void Dispose() => _folder.Dispose();

    [Fact]
    public void Simulate_OfAScene_WritesOneRowPerBodyAndStep()
    {
        var (exitCode, output, error) = Run("simulate", "scene.sdo", "--seconds", "2");
        Assert.Equal(0, exitCode);
        Assert.EndsWith("\n", output, StringComparison.Ordinal);
        var rows = SimulateCommandTests.Rows(output);
        Assert.Equal(3 * 120, rows.Length);
        for (var i = 0; i < rows.Length; i++)
        {
            Assert.Equal(((i / 3) + 1) * (1 / 60.0), rows[i].Numbers[0]);
            Assert.Equal((string[])["\"red, large\"", "#1", "thin"], rows.Skip(i / 3 * 3).Take(3).Select(row => row.Body));
        }

        // The first step is free fall, h = 2 − g·t²/2, up to the rounding of the sum.
        Near.Equal(2 - (0.5 * 9.8 / 3600), rows[0].Numbers[2], 1e-15);
        Near.Equal(-9.8 / 60, rows[0].Numbers[5], 1e-15);
        Assert.Matches(@"^bodies 3\nbuild [\d.]+ ms\nsteps 120\nstep [\d.]+ ms\nasleep \d\nstuck 0\nstate [0-9a-f]{16}\n$",
            error.ReplaceLineEndings("\n"));
    }

    [Fact]
    public void Simulate_WithOutput_WritesTheSameIntoAFile()
    {
        var (exitCode, output, error) = Run("simulate", "scene.sdo", "--seconds", "1", "--output", "a/bodies.csv");
        Assert.Equal((0, ""), (exitCode, output));
        var toStdout = Run("simulate", "scene.sdo", "--seconds", "1");
        Assert.Equal(toStdout.Output, File.ReadAllText(_folder["a/bodies.csv"]));
        Assert.Equal(SimulateCommandTests.State(toStdout.Error), SimulateCommandTests.State(error));
        Assert.Single(Directory.GetFiles(_folder["a"]));
    }

    [Fact]
    public void Simulate_Again_EndsInTheSameState()
    {
        var first = Run("simulate", "scene.sdo", "--seconds", "3");
        var oneProcessor = AppProcess.Run(_folder.Path, new Dictionary<string, string?> { ["DOTNET_PROCESSOR_COUNT"] = "1" }, "simulate",
            "scene.sdo", "--seconds", "3");
        Assert.Equal((0, first.Output), (oneProcessor.ExitCode, oneProcessor.Output));
        Assert.Equal(SimulateCommandTests.State(first.Error), SimulateCommandTests.State(oneProcessor.Error));
        var shorter = Run("simulate", "scene.sdo", "--seconds", "2");
        Assert.NotEqual(SimulateCommandTests.State(first.Error), SimulateCommandTests.State(shorter.Error));
    }

    [Theory]
    [InlineData("de_DE.UTF-8")]
    [InlineData("tr_TR.UTF-8")]
    public void Simulate_InAnyCulture_WritesTheSame(string culture)
    {
        var expected = Run("simulate", "scene.sdo", "--seconds", "0.5", "--step", "0.01");
        var there = AppProcess.Run(
            _folder.Path, new Dictionary<string, string?> { ["LC_ALL"] = culture, ["LANG"] = culture }, "simulate", "scene.sdo",
            "--seconds", "0.5", "--step", "0.01");
        Assert.Equal((0, expected.Output), (there.ExitCode, there.Output));
        Assert.Equal(SimulateCommandTests.State(expected.Error), SimulateCommandTests.State(there.Error));
        Assert.Equal(3 * 50, SimulateCommandTests.Rows(there.Output).Length);
    }

    [SkippableTheory]
    [InlineData("INT")]
    [InlineData("TERM")]
    public void Simulate_Interrupted_WritesNothing(string signal)
    {
        Assert.Equal(
            (130, "error: interrupted"),
            Signals.EndWhileWriting(_folder, signal, "simulate", "scene.sdo", "--seconds", "100000", "--output", "bodies.csv"));
        Assert.Equal(["cube.obj", "row.fdo", "scene.sdo", "still.sdo"], Directory.GetFiles(_folder.Path).Select(Path.GetFileName).Order());
    }

    private AppResult Run(params string[] arguments) => AppProcess.Run(_folder.Path, arguments);
}
