using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Views;
using FractalEngine.Parsing.Assets;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.App;

/// <summary>What is around meshes and fractals that are opened alone.</summary>
public sealed class StageTests : DrawingCommandTests
{
    public StageTests() =>
        Folder.Write("row.fdo", "v 0.4 0.7 0\nx. \"cube.obj\"\nt. (1, #, (0.5))\nz<x>. [t.] x\n<$>. z 3\n");

    [Theory]
    [InlineData("fractals/tree.fdo", true)]
    [InlineData("fractals/infinite-menger.fdo", true)]
    [InlineData("examples/tree-08.fdo", true)]
    [InlineData("chance/coral.fdo", false)]
    [InlineData("models/crate.obj", false)]
    [InlineData("models/drum.obj", false)]
    public void Load_OfOneModel_StandsInTheSun(string name, bool hasPalette)
    {
        var path = Repository.Full($"assets/{name}");
        var plain = AssetLoader.Load(path).Scene.Scene;
        var staged = AssetLoader.Load(path, new() { IsStaged = true }).Scene;

        Assert.Equal((null, 0, null), (plain.Sky, plain.Lights.Length, plain.Objects[0].Gradient));
        Assert.NotNull(staged.Scene.Sky);
        var gradient = Assert.Single(staged.Scene.Objects).Gradient;
        Assert.Equal(hasPalette ? GradientKind.Height : null, gradient?.Kind);
        // From the left, from above, and from behind the camera, however the scene is handed.
        var light = Assert.Single(staged.Scene.Lights).ToEmitter()!.Axis;
        var (right, up, forward) = CameraFraming.Default(staged, 1.5).LocalAxes;
        Assert.True(Vector.Dot(light, right) > 0.2 && Vector.Dot(light, up) < -0.2 && Vector.Dot(light, forward) > 0.1);
    }

    [Fact]
    public void Load_OfAScene_ChangesNothing()
    {
        var path = Repository.Full("assets/scenes/fern.sdo");
        Assert.Equal(AssetLoader.Load(path).Scene.Scene, AssetLoader.Load(path, new() { IsStaged = true }).Scene.Scene);
    }

    [Fact]
    public void Render_Plain_IsTheImageOfASceneOfTheObject()
    {
        Folder.Write("scene-of-row.sdo", "o \"row.fdo\" #\n");
        byte[] Pixels(string file, params string[] options)
        {
            var (exitCode, _, _) = AppProcess.Run(
                Folder.Path, ["render", file, "-o", "a.png", "--trace", "1", "--resolution", "16x12", .. options]);
            Assert.Equal(0, exitCode);
            return ReadImage("a.png").Pixels;
        }

        Assert.Equal(Pixels("scene-of-row.sdo"), Pixels("row.fdo", "--plain"));
        Assert.NotEqual(Pixels("row.fdo", "--plain"), Pixels("row.fdo"));
    }
}
