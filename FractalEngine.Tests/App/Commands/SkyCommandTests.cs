using FractalEngine.Core.Images;
using FractalEngine.Core.Scenes.Lights;
using FractalEngine.Parsing;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.App.Commands;

/// <summary>Tests the command <c>sky</c>.</summary>
[Collection(ConsoleTests.Name)]
public sealed class SkyCommandTests : IDisposable
{
    private readonly TemporaryFolder _folder = new();

    public void Dispose() => _folder.Dispose();

    [Fact]
    public void Sky_OfAClearDay_IsWrittenWithTheLinesThatShowIt()
    {
        var (exitCode, output, error) = Run(
            "sky", "-o", "a.hdr", "--resolution", "64x32", "--sun-height", "20", "--sun-azimuth", "90", "--haze", "2", "--no-sun");
        Assert.Equal(0, exitCode);
        Assert.Matches(@"^wrote a\.hdr: 64×32 pixels, [0-9.]+ kB, [0-9.]+ s\n$", error);
        File.WriteAllText(_folder["s.sdo"], output);
        var scene = SceneFile.Read(_folder["s.sdo"]);
        var sky = Assert.IsType<ImageSky>(scene.Sky);
        Assert.Equal((64, 32), (sky.Image!.Levels[0].Width, sky.Image.Levels[0].Height));
        // The sun stands to the right, so its light travels to the left and down.
        var sun = Assert.IsType<SunLight>(Assert.Single(scene.Lights));
        Assert.True(sun.Direction is { X: < -0.9, Y: < 0 });
        Assert.InRange(sky.Image.Levels[0].Pixels.Max(), 0, 3);
    }

    [Fact]
    public void Sky_WithItsSun_IsTheSameBytesEachTime()
    {
        Assert.Equal("sky \"a.hdr\"\n", Run("sky", "-o", "a.hdr", "--resolution", "40x20").Output);
        Run("sky", "-o", "b.hdr", "--resolution", "40x20");
        Assert.Equal(File.ReadAllBytes(_folder["a.hdr"]), File.ReadAllBytes(_folder["b.hdr"]));
        Assert.InRange(RadianceFile.Read(File.ReadAllBytes(_folder["a.hdr"]), 800).Pixels.Max(), 50, 1e4);
    }

    [Theory]
    [InlineData("--resolution", "20000x10000")]
    [InlineData("--sun-height", "91")]
    [InlineData("--haze", "-1")]
    [InlineData("-o", "b.png")]
    public void Sky_OfInvalidOptions_IsWrongUsage(string option, string value) =>
        Assert.Equal(2, Run(option == "-o" ? ["sky", option, value] : ["sky", "-o", "a.hdr", option, value]).ExitCode);

    private AppResult Run(params string[] arguments) => AppInProcess.Run(_folder.Path, arguments);
}
