using FractalEngine.Parsing.Assets;
using FractalEngine.Parsing.Simulation;
using FractalEngine.Render.Images;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.App;

/// <summary>Tests the frames of <c>animate --trace</c>, for which no display is needed.</summary>
[Collection(ConsoleTests.Name)]
public sealed class TracedAnimationTests : IDisposable
{
    private static readonly string[] Traced = ["--trace", "2", "--resolution", "24x16"];

    private readonly TemporaryFolder _folder = new();

    public TracedAnimationTests()
    {
        _folder.Write("cube.obj", SampleFiles.Cube);
        _folder.Write("scene.sdo", "background (0, 0, 1)\no \"cube.obj\" # colour (1, 0, 0)\nc (0, 0, -3) # 60\n");
        _folder.Write(
            "drop.sdo", "p \"cube.obj\" ((0, 1.5, 0), #, #) 0.5 colour (1, 0, 0)\no \"cube.obj\" ((0, -2, 0), #, #)\nc (0, 0, -5) # 60\n");
    }

    public void Dispose() => _folder.Dispose();

    [Fact]
    public void Path_Traced_HasTheFramesOfStillImages()
    {
        _folder.Write("cameras.txt", "(0, 0, -3) look-at (0, 0, 0) 60\n(3, 0, 0) look-at (0, 0, 0) 60\n");
        AssertFrames(
            "scene.sdo", ["--path", "cameras.txt"], ["--look-from", "(0, 0, -3)", "--look-at", "(0, 0, 0)"],
            ["--look-from", "(3, 0, 0)", "--look-at", "(0, 0, 0)"]);
    }

    [Fact]
    public void Path_FarAway_KeepsItsDirection()
    {
        // At 1e17 the next double is 16 units away, so that a point before the camera would be the camera's own.
        _folder.Write("cameras.txt", "(1e17, 0, 0) (0, 0, 0) 60\n(1e17, 0, 0) (0, 1, 0) 60\n");
        Animate("scene.sdo", "--path", "cameras.txt");
    }

    [Fact]
    public void Path_BeyondTheLimit_NamesTheLine()
    {
        _folder.Write("cameras.txt", "(0, 0, -5) (0, 0, 0) 60\n(1e308, 0, 0) (0, 0, 0) 60\n");
        Assert.Equal(
            new AppResult(3, "", "cameras.txt:2:1: error: the camera of a path is beyond the limit of 1e150\n"),
            AppInProcess.Run(_folder.Path, ["animate", "scene.sdo", "--path", "cameras.txt", .. Traced, "--output", "f.png"]));
    }

    /// <summary>The last frame leads on to the first: of two, it shows the other side.</summary>
    [Fact]
    public void Turntable_OfTwoFrames_EndsOnTheOtherSide()
    {
        _folder.Write(
            "two.sdo", "o \"cube.obj\" # colour (1, 0, 0)\no \"cube.obj\" ((2, 0, 0), #, #) colour (0, 1, 0)\nc (1, 0, -5) # 60\n");
        Animate("two.sdo", "--turntable");
        var difference = Pixels("f-0001.png").Zip(Pixels("f-0002.png")).Average(static pair => Math.Abs(pair.First - pair.Second));
        Assert.True(difference > 2, $"{difference}");
    }

    [Fact]
    public void Turntable_Traced_BeginsWithTheStillImageAndSharesItsSeed()
    {
        Animate("scene.sdo", "--turntable", "--seed", "5");
        Assert.Equal(Render("scene.sdo", "--seed", "5"), Pixels("f-0001.png"));
        Assert.NotEqual(Render("scene.sdo"), Pixels("f-0001.png"));
    }

    [Fact]
    [Trait("Category", "Soak")]
    public void Zoom_Traced_EndsWithTheStillImage()
    {
        var zoom = Repository.Full("assets/examples/zoom.sdo");
        Animate(zoom, "--zoom", "2");
        Assert.Equal(Render(zoom, "--zoom", "2"), Pixels("f-0002.png"));
    }

    [Fact]
    public void Simulate_Traced_HasTheFramesOfStillImages() =>
        AssertFrames("drop.sdo", ["--simulate", "--fps", "5", "--time", "0.2"], ["--time", "0.2"], ["--time", "0.4"]);

    [Fact]
    public void Time_OfAStillScene_IsThatOfItsFrames()
    {
        Animate("drop.sdo", "--turntable", "--time", "0.4");
        Assert.Equal(Render("drop.sdo", "--time", "0.4"), Pixels("f-0001.png"));
        Assert.NotEqual(Render("drop.sdo"), Pixels("f-0001.png"));
    }

    [Fact]
    public void Bodies_BetweenTwoSteps_AreBetweenTheirPlaces()
    {
        var file = AssetLoader.Load(_folder["drop.sdo"]);
        var bodies = new AnimatedBodies("drop.sdo", file, file.Scene);
        Assert.False(bodies.AdvanceTo(0, CancellationToken.None));
        double HeightAt(double steps)
        {
            Assert.True(bodies.AdvanceTo(steps / 60, CancellationToken.None));
            var height = bodies.GetScene().Objects[0].ObjectToWorld.Translation.Y;
            // The map of a drawn frame is computed by another formula, so that it may differ by rounding.
            Assert.Equal(height, bodies.Maps[0].Map.Translation.Y, 1e-12);
            // A still image shows the same, to the bit.
            var still = AnimatedBodies.SceneAfter("drop.sdo", file, file.Scene, steps / 60);
            Assert.Equal(height, still.Objects[0].ObjectToWorld.Translation.Y);
            return height;
        }

        // The nearest step of the first is the beginning.
        Assert.InRange(HeightAt(0.4), 1.49, 1.4999);
        var (height2, height225, height3) = (HeightAt(2), HeightAt(2.25), HeightAt(3));
        Assert.True(height2 > height3);
        Assert.Equal((0.75 * height2) + (0.25 * height3), height225, 1e-12);
    }

    [Fact]
    public void Bodies_AtTheEndOfAStep_HaveTheBitsOfThatStep()
    {
        var file = AssetLoader.Load(_folder["drop.sdo"]);
        var bodies = new AnimatedBodies("drop.sdo", file, file.Scene);
        var world = SceneWorld.Create(file, file.Scene, new());
        for (var step = 1; step <= 600; step++)
        {
            world.Step();
            bodies.AdvanceTo(step / 60.0, CancellationToken.None);
            Assert.Equal(world.GetCurrentScene().Objects[0].ObjectToWorld, bodies.GetScene().Objects[0].ObjectToWorld);
        }
    }

    /// <summary>Requires the two frames of an animation to be two still images, to the bit, which differ.</summary>
    private void AssertFrames(string file, string[] motion, string[] first, string[] second)
    {
        Animate(file, motion);
        Assert.Equal(Render(file, first), Pixels("f-0001.png"));
        Assert.Equal(Render(file, second), Pixels("f-0002.png"));
        Assert.NotEqual(Pixels("f-0001.png"), Pixels("f-0002.png"));
    }

    private void Animate(string file, params string[] options) =>
        Run(["animate", file, "--frames", "2", "--output", "f.png", .. Traced, .. options]);

    private byte[] Render(string file, params string[] options)
    {
        Run(["render", file, "--output", "a.png", .. Traced, .. options]);
        return Pixels("a.png");
    }

    private void Run(string[] arguments)
    {
        var (exitCode, _, error) = AppInProcess.Run(_folder.Path, arguments);
        Assert.True(exitCode == 0, error);
    }

    private byte[] Pixels(string file) => ImageFile.Load(_folder[file]).Pixels;
}
