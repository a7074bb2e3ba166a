using System.Globalization;
using FractalEngine.Benchmarks.Drawing;
using FractalEngine.Core.Images;
using FractalEngine.Render.Images;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.App.Commands;

/// <summary>Tests that the fractal which <c>approximate</c> writes is used as the mesh that it was found for.</summary>
[Collection(ConsoleTests.Name)]
public sealed class ApproximatedUseTests : IDisposable
{
    private readonly TemporaryFolder _folder = new();

    public ApproximatedUseTests()
    {
        var classic = Repository.Full("assets/classics/vicsek.fdo");
        // Colours of maps are lost.
        Assert.Equal(0, Run("export", classic, "--output", "mesh.obj", "--no-materials", "--quiet").ExitCode);
        Assert.Equal(0, Run("approximate", "mesh.obj", "--output", "found.fdo", "--quiet").ExitCode);
    }

    public void Dispose() => _folder.Dispose();

    [Fact]
    public void Query_OfWhatWasFound_HasTheDistancesOfTheMesh()
    {
        var random = new Random(3);
        _folder.Write("points.txt", string.Concat(Enumerable.Range(0, 200).Select(
            _ => $"{random.Next(-999, 999)}e-3 {random.Next(-999, 999)}e-3 {random.Next(-999, 999)}e-3\n")));
        var (expected, actual) = (DistancesTo("mesh.obj"), DistancesTo("found.fdo"));
        Assert.Equal(200, expected.Length);
        Assert.All(expected.Zip(actual), pair => Assert.Equal(pair.First, pair.Second, 1e-12));

        double[] DistancesTo(string file) =>
        [
            .. Run("query", file, "--points", "points.txt").Output.Split('\n', StringSplitOptions.RemoveEmptyEntries)
                .Select(line => double.Parse(line.Split(' ')[0], CultureInfo.InvariantCulture)),
        ];
    }

    [SkippableFact]
    public void Render_OfWhatWasFound_LooksAsTheMesh()
    {
        Display.Require();
        var mesh = Render("mesh.obj");
        Assert.NotEqual(mesh[0, 0], mesh[80, 60]);
        Assert.InRange(ImageError.PeakSignalToNoiseRatio(Render("found.fdo"), mesh), 45, double.PositiveInfinity);
    }

    [Fact]
    public void Simulate_OnWhatWasFound_RestsAsOnTheMesh()
    {
        var (expected, actual) = (RestOn("mesh.obj"), RestOn("found.fdo"));
        Assert.Equal("1", expected[8]);
        Assert.Equal(expected[8], actual[8]);
        // The same up to rounding in each of 240 steps.
        Assert.All(Enumerable.Range(2, 3), axis => Assert.Equal(
            double.Parse(expected[axis], CultureInfo.InvariantCulture), double.Parse(actual[axis], CultureInfo.InvariantCulture), 1e-9));

        string[] RestOn(string file)
        {
            _folder.Write("cube.obj", SampleFiles.Cube);
            const string Ball = "p \"cube.obj\" ((0.02, 0.8, 0.01), #, (0.1, 0.1, 0.1)) 0.2 friction 0.8 rolling 0.8";
            _folder.Write("ball.sdo", $"o \"{file}\" #\n{Ball}\n");
            Assert.Equal(0, Run("simulate", "ball.sdo", "--seconds", "4", "--output", "ball.csv").ExitCode);
            return File.ReadLines(_folder["ball.csv"]).Last().Split(',');
        }
    }

    /// <summary>Draws every instance, without what fractals have of their levels: proxies and ambient occlusion.</summary>
    /// <remarks>In a scene both have its handedness, while a mesh alone is right-handed.</remarks>
    private PixelImage Render(string file)
    {
        _folder.Write("scene.sdo", $"c (1.3, 1.9, -4) look-at (0, 0, 0) 20\no \"{file}\" #\n");
        Assert.Equal(0, Run(
            "render", "scene.sdo", "--output", $"{file}.png", "--resolution", "160x120", "--detail", "0", "--quiet").ExitCode);
        return ImageFile.Load(_folder[$"{file}.png"]);
    }

    private AppResult Run(params string[] arguments) => AppInProcess.Run(_folder.Path, arguments);
}
