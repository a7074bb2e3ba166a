using System.Globalization;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.App.Commands;

/// <summary>Tests the command <c>simulate</c>, which writes one row per body and step, the same in every run.</summary>
[Collection(ConsoleTests.Name)]
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

    /// <summary>The line of the report that tells the state of all bodies.</summary>
    internal static string State(string error) =>
        Assert.Single(error.Split('\n'), line => line.StartsWith("state ", StringComparison.Ordinal)).Trim();

    /// <summary>Parses the rows below the header: the body as written, and the nine numbers around it.</summary>
    internal static (string Body, double[] Numbers)[] Rows(string table)
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

    /// <summary>Runs a command in the process of the tests, which has no standard output for rows: they go into a file.</summary>
    private AppResult Run(params string[] arguments)
    {
        File.Delete(_folder["rows.csv"]);
        var result = AppInProcess.Run(_folder.Path, arguments.Contains("--output") ? arguments : [.. arguments, "--output", "rows.csv"]);
        return File.Exists(_folder["rows.csv"]) ? result with { Output = File.ReadAllText(_folder["rows.csv"]) } : result;
    }
}
