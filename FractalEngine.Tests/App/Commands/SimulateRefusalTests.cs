using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.App.Commands;

/// <summary>Tests that <c>simulate</c> says what it can't do, and writes nothing then.</summary>
[Collection(ConsoleTests.Name)]
public sealed class SimulateRefusalTests : IDisposable
{
    private readonly TemporaryFolder _folder = new();

    public SimulateRefusalTests() => SimulateCommandTests.WriteFiles(_folder);

    public void Dispose() => _folder.Dispose();

    [Theory]
    [InlineData("p \"cube.obj\" ((1e151, 2, 0), #, #) 0.5 name \"far\"", "far.sdo:1:1: error: the position of body far")]
    [InlineData("p \"cube.obj\" # 0.5 velocity (0, 1e160, 0)", "far.sdo:1:1: error: the velocity of body #0")]
    [InlineData("p \"cube.obj\" # 0.5\ngravity (0, 1e200, 0)", "error: gravity")]
    [InlineData("p \"cube.obj\" # 0 velocity (9e149, 0, 0)\ngravity (1e149, 0, 0)", "far.sdo:1:1: error: the velocity of body #0")]
    public void Simulate_BeyondTheRangeOfPhysics_NamesTheLimit(string scene, string subject)
    {
        // Such bodies stood still, without a word.
        _folder.Write("far.sdo", scene + "\n");
        var (exitCode, _, error) = Run("simulate", "far.sdo", "--seconds", "2");
        Assert.Equal(3, exitCode);
        Assert.StartsWith($"{subject} is beyond the limit of 1e150 of physics", error, StringComparison.Ordinal);
    }

    [Theory]
    [InlineData("mass 1e70", "far.sdo:1:1: error: the mass of body #0 is beyond the limit from 1e-60 to 1e60 of physics")]
    [InlineData("mass 1\no \"cube.obj\" # belt (1e200, 0, 0)", "far.sdo:2:1: error: the belt of cube.obj is beyond the limit of 1e150")]
    [InlineData("mass 1\no \"cube.obj\" # moving velocity (1e200, 0, 0)", "far.sdo:2:1: error: the motion of cube.obj is beyond")]
    [InlineData("mass 1\no \"cube.obj\" # moving spin (0, 1e12, 0)", "far.sdo:2:1: error: the motion of cube.obj is beyond")]
    public void Simulate_BeyondTheRangeOfMassesAndMotions_NamesTheLimit(string options, string message)
    {
        _folder.Write("far.sdo", $"p \"cube.obj\" # 0.5 {options}\n");
        var (exitCode, _, error) = Run("simulate", "far.sdo", "--seconds", "2");
        Assert.Equal(3, exitCode);
        Assert.StartsWith(message, error, StringComparison.Ordinal);
    }

    [Theory]
    [InlineData("still.sdo")]
    [InlineData("cube.obj")]
    [InlineData("row.fdo")]
    public void Simulate_WithoutBodies_ReportsThatNothingMoves(string file) => Assert.Equal(
        new AppResult(2, "", $"error: {file} has no physics objects, so there is nothing to simulate\n"), Run("simulate", file));

    [Theory]
    [InlineData("--seconds", "0")]
    [InlineData("--seconds", "-1")]
    [InlineData("--seconds", "NaN")]
    [InlineData("--seconds", "Infinity")]
    [InlineData("--seconds", "1,5")]
    [InlineData("--step", "0")]
    [InlineData("--step", "nan")]
    [InlineData("--collider", "sphere")]
    [InlineData("--output", "bodies.txt")]
    [InlineData("--output", "row.fdo/bodies.csv")]
    public void Simulate_WithInvalidOptions_IsWrongUsage(params string[] options)
    {
        var (exitCode, output, error) = Run(["simulate", "scene.sdo", .. options]);
        Assert.Equal((2, ""), (exitCode, output));
        Assert.StartsWith("error: ", error, StringComparison.Ordinal);
        Assert.DoesNotContain("   at ", error, StringComparison.Ordinal);
    }

    [Fact]
    public void Simulate_OfABodyWithoutSize_NamesIt()
    {
        _folder.Write("point.obj", "v 0 0 0\nf 1 1 1\n");
        _folder.Write("point.sdo", "# one line\no \"cube.obj\" #\n  p \"point.obj\" # 0.5 name \"dot\"\n");
        Assert.Equal(
            new AppResult(
                1, "", "point.sdo:3:3: error: body dot: the radius must be positive\n    p \"point.obj\" # 0.5 name \"dot\"\n    ^\n"),
            Run("simulate", "point.sdo"));
        _folder.Write("point.sdo", "p \"point.obj\" # 0.5\n");
        Assert.StartsWith(
            "point.sdo:1:1: error: body point.obj: the radius must be positive\n", Run("simulate", "point.sdo").Error,
            StringComparison.Ordinal);
    }

    [Theory]
    [InlineData("--step", "1e-7")]
    [InlineData("--seconds", "1e300", "--step", "1e-300")]
    public void Simulate_OfTooManySteps_IsOverTheLimit(params string[] options)
    {
        var (exitCode, output, error) = Run(["simulate", "scene.sdo", .. options]);
        Assert.Equal((3, ""), (exitCode, output));
        Assert.EndsWith("exceeds the limit of 10000000 steps\n", error, StringComparison.Ordinal);
    }

    [Fact]
    public void Simulate_BeyondTheRangeOfPhysics_WritesNothingAndNamesTheBody()
    {
        _folder.Write("far.sdo", "p \"cube.obj\" # 0.5 name \"comet\" velocity (9e149, 0, 0)\ngravity (1e149, 0, 0)\n");
        File.WriteAllText(_folder["bodies.csv"], "before");
        var (exitCode, output, error) = Run("simulate", "far.sdo", "--output", "bodies.csv");
        Assert.Equal((3, ""), (exitCode, output));
        Assert.StartsWith(
            "far.sdo:1:1: error: the velocity of body comet is beyond the limit of 1e150 of physics", error, StringComparison.Ordinal);
        Assert.Equal("before", File.ReadAllText(_folder["bodies.csv"]));
        Assert.Empty(Directory.GetFiles(_folder.Path, "*.tmp"));
    }

    private AppResult Run(params string[] arguments) => AppInProcess.Run(_folder.Path, arguments);
}
