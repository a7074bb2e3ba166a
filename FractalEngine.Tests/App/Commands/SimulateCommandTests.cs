using System.Globalization;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.App.Commands;

/// <summary>Tests the command <c>simulate</c>, which writes one row per body and step, the same in every run.</summary>
public sealed class SimulateCommandTests : IDisposable
{
    private const string Header = "time,body,x,y,z,vx,vy,vz,asleep,faceTests,wx,wy,wz,rx,ry,rz";

    private readonly TemporaryFolder _folder = new();

    public SimulateCommandTests() => WriteFiles(_folder);

    public void Dispose() => _folder.Dispose();

    /// <summary>Writes a scene with three bodies and what it refers to.</summary>
    internal static void WriteFiles(TemporaryFolder folder)
    {
        folder.Write("cube.obj", SampleFiles.Cube);
        folder.Write("row.fdo", SampleFiles.Row("3"));
        folder.Write("still.sdo", "o \"cube.obj\" #\n");
        // The name of the first body needs quotes, and the second body has none. A radius is half a cube's diagonal, 0.866 sides.
        folder.Write("scene.sdo", """
            o "cube.obj" ((0, -0.5, 0), #, (20, 1, 20)) name "ground"
            o "row.fdo" ((3, 0, 0), #, #)
            p "cube.obj" ((0, 2, 0), #, #) 0.5 name "red, large" friction 0.5
            p "cube.obj" ((3.1, 4, 0.05), #, (0.5, 0.5, 0.5)) 0.25 friction 0.5 collider hierarchy
            p "cube.obj" ((-4, 3, 0), #, #) 0 name "thin" shrink 0.2 0.5
            """);
    }

    [Fact]
    public void Simulate_OfAScene_WritesOneRowPerBodyAndStep()
    {
        var (exitCode, output, error) = Run("simulate", "scene.sdo", "--seconds", "2");
        Assert.Equal(0, exitCode);
        Assert.EndsWith("\n", output, StringComparison.Ordinal);
        var rows = Rows(output);
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
    public void Simulate_ForLessThanAStep_TakesOne()
    {
        _folder.Write("one.sdo", "p \"cube.obj\" # 0.5\n");
        var (exitCode, _, error) = Run("simulate", "one.sdo", "--seconds", "1", "--step", "1000000");
        Assert.Equal(0, exitCode);
        Assert.Contains("steps 1\n", error);
    }

    [Fact]
    public void Simulate_UntilAllBodiesRest_ReportsThemAsleep()
    {
        var (_, output, error) = Run("simulate", "scene.sdo", "--seconds", "20");
        var last = Rows(output)[^3..];
        Assert.All(last, row => Assert.Equal((0, 0, 0, 1), (row.Numbers[4], row.Numbers[5], row.Numbers[6], row.Numbers[7])));
        Assert.Contains("asleep 3", error, StringComparison.Ordinal);
        // Balls of radius √3/2 lie on a floor at height 0, and one of them has shrunk to half. The tolerance covers their last motion
        // before they fall asleep.
        Near.Equal(Math.Sqrt(3) / 2, last[0].Numbers[2], 1e-6);
        Near.Equal(Math.Sqrt(3) / 4, last[2].Numbers[2], 1e-6);
    }

    [Fact]
    public void Simulate_WithOutput_WritesTheSameIntoAFile()
    {
        var (exitCode, output, error) = Run("simulate", "scene.sdo", "--seconds", "1", "--output", "a/bodies.csv");
        Assert.Equal((0, ""), (exitCode, output));
        var toStdout = Run("simulate", "scene.sdo", "--seconds", "1");
        Assert.Equal(toStdout.Output, File.ReadAllText(_folder["a/bodies.csv"]));
        Assert.Equal(State(toStdout.Error), State(error));
        Assert.Single(Directory.GetFiles(_folder["a"]));
    }

    [Fact]
    public void Simulate_Again_EndsInTheSameState()
    {
        var first = Run("simulate", "scene.sdo", "--seconds", "3");
        var oneProcessor = AppProcess.Run(_folder.Path, new Dictionary<string, string?> { ["DOTNET_PROCESSOR_COUNT"] = "1" }, "simulate",
            "scene.sdo", "--seconds", "3");
        Assert.Equal((0, first.Output), (oneProcessor.ExitCode, oneProcessor.Output));
        Assert.Equal(State(first.Error), State(oneProcessor.Error));
        Assert.NotEqual(State(first.Error), State(Run("simulate", "scene.sdo", "--seconds", "2").Error));
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
        Assert.Equal(State(expected.Error), State(there.Error));
        Assert.Equal(3 * 50, Rows(there.Output).Length);
    }

    [Theory]
    [InlineData("1", "0.1", 10)]
    [InlineData("1", "0.3", 4)]
    [InlineData("10", "0.0166667", 600)]
    [InlineData("0.001", "1", 1)]
    [InlineData("1e-12", "1", 1)]
    [InlineData("1e-300", "0.1", 1)]
    [InlineData("3.0000000001", "1", 3)]
    public void Simulate_OfADuration_MakesAsManyStepsAsReachItsEnd(string seconds, string step, int steps) =>
        Assert.Equal(3 * steps, Rows(Run("simulate", "scene.sdo", "--seconds", seconds, "--step", step).Output).Length);

    [Theory]
    [InlineData("hierarchy")]
    [InlineData("simple")]
    public void Simulate_WithAnotherExactCollider_MovesAlike(string collider)
    {
        var (expected, actual) =
            (Rows(Run("simulate", "scene.sdo").Output), Rows(Run("simulate", "scene.sdo", "--collider", collider).Output));
        Assert.NotEmpty(expected);
        Assert.Equal(expected.Length, actual.Length);
        for (var i = 0; i < expected.Length; i++)
        {
            // The closest points are equal up to rounding, which some bounces amplify.
            Near.Equal(expected[i].Numbers[2], actual[i].Numbers[2], 1e-6);
        }
    }

    [Fact]
    public void Simulate_WithAColliderThatDoesNotFit_NamesTheFile()
    {
        var expected = new AppResult(
            2, "",
            "error: cube.obj: the collider 'fractal' needs a fractal, and this is a mesh: "
            + "expected exact, hierarchy, bounding-box or simple\n");
        // Beside a fractal, a mesh takes the hierarchy.
        Assert.Equal(0, Run("simulate", "scene.sdo", "--collider", "fractal", "--seconds", "1").ExitCode);
        _folder.Write("own.sdo", "o \"cube.obj\" #\np \"cube.obj\" ((0, 500, 0), #, #) 1 collider fractal\n");
        Assert.Equal(expected, Run("simulate", "own.sdo", "--output", "bodies.csv"));
        Assert.Equal(expected, Run("simulate", "own.sdo", "--collider", "fractal"));
        Assert.Equal(0, Run("simulate", "own.sdo", "--collider", "exact", "--seconds", "1").ExitCode);
        Assert.False(File.Exists(_folder["bodies.csv"]));
    }

    [SkippableTheory]
    [InlineData("INT")]
    [InlineData("TERM")]
    public void Simulate_Interrupted_WritesNothing(string signal)
    {
        Signals.Require(signal);
        using var process = AppProcess.Start(_folder.Path, [], "simulate", "scene.sdo", "--seconds", "100000", "--output", "bodies.csv");
        try
        {
            Polling.WaitUntil(() => Directory.GetFiles(_folder.Path, "*.tmp").Length > 0, "output file");
            Signals.Send(process, signal);
            Assert.True(process.WaitForExit(Polling.Deadline), "the process does not end");
        }
        finally
        {
            process.Kill();
        }

        Assert.Equal((130, "error: interrupted"), (process.ExitCode, process.StandardError.ReadToEnd().Trim()));
        Assert.Equal(["cube.obj", "row.fdo", "scene.sdo", "still.sdo"], Directory.GetFiles(_folder.Path).Select(Path.GetFileName).Order());
    }

    private static string State(string error) =>
        Assert.Single(error.Split('\n'), line => line.StartsWith("state ", StringComparison.Ordinal)).Trim();

    /// <summary>Parses the rows below the header: the body as written, and the nine numbers around it.</summary>
    private static (string Body, double[] Numbers)[] Rows(string table)
    {
        var lines = table.Split('\n');
        Assert.Equal((Header, ""), (lines[0], lines[^1]));
        return [.. lines[1..^1].Select(Row)];
    }

    private static (string Body, double[] Numbers) Row(string line)
    {
        var (first, end) = (line.IndexOf(',', StringComparison.Ordinal), line.Length);
        for (var number = 0; number < 14; number++)
        {
            end = line.LastIndexOf(',', end - 1);
        }

        double[] numbers = [.. $"{line[..first]}{line[end..]}".Split(',').Select(text => double.Parse(text, CultureInfo.InvariantCulture))];
        return (line[(first + 1)..end], numbers);
    }

    private AppResult Run(params string[] arguments) => AppProcess.Run(_folder.Path, arguments);
}
