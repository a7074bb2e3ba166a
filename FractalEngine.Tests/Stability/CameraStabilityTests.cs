using System.Runtime.CompilerServices;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Images;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Core.Scenes.Lights;
using FractalEngine.Core.Views;
using FractalEngine.Render;
using FractalEngine.Render.Preparation;
using FractalEngine.Render.Views;
using FractalEngine.Tests.Fractals;
using FractalEngine.Tests.Render;
using FractalEngine.Tests.Support;
using Xunit.Abstractions;

namespace FractalEngine.Tests.Stability;

/// <summary>
/// Moves a camera deep into a fractal and back. FractalAddressTests do so for more fractals. DeepZoomDrawingTests compare neighbouring
/// levels, and frames that world space can still describe.
/// </summary>
[Collection(GlTests.Name)]
public sealed class CameraStabilityTests(ITestOutputHelper output)
{
    private const int Width = 160;
    private const int Height = 120;

    // All ancestors that are drawn around the camera. From this depth on, frames of self-similar fractals are the same.
    private const int MaxAncestors = 30;

    private static readonly RenderSettings Settings = new() { Samples = 0 };
    private static readonly Vector Direction = new Vector(-1, -0.8, -0.9).UnitVector();

    [Theory]
    [InlineData("menger", 10_000)]
    [InlineData("turned", 10_000)]
    [InlineData("sierpinski", 10_000)]
    public void Camera_GoingInAndOutAgain_IsWhereItBegan(string name, int depth) => CheckThereAndBack(name, depth);

    [Theory]
    [InlineData("menger")]
    [InlineData("turned")]
    [InlineData("sierpinski")]
    [Trait("Category", "Soak")]
    public void Camera_GoingAMillionLevelsInAndOutAgain_IsWhereItBegan(string name) =>
        CheckThereAndBack(name, (int)FractalLimits.Depth.Value);

    /// <summary>Each frame shows the whole fractal from the same side. The depth does not change a pixel.</summary>
    [SkippableTheory]
    [InlineData("sierpinski")]
    public void Frame_OfASelfSimilarFractal_IsTheSameAtAnyDepth(string name) => CheckFrames(name, [41, 1040]);

    [SkippableTheory]
    [InlineData("menger")]
    [InlineData("sierpinski")]
    [Trait("Category", "Soak")]
    public void Frame_OfASelfSimilarFractal_IsTheSameAMillionLevelsDown(string name) => CheckFrames(name, [42, 47, 1040, 100_000, 999_990]);

    private void CheckThereAndBack(string name, int maxDepth, [CallerMemberName] string test = "")
    {
        using var report = new StabilityReport(output, name, test);
        foreach (var depth in RoundNumbers.To(maxDepth))
        {
            var dive = FractalAddressTests.CreateDive(name, 0, AffineMap.Identity);
            var (frameToCamera, size) = (dive.Address.FrameToCamera, dive.Start.Length() + 1);
            dive.GoToDepth(depth);
            Assert.Equal(depth, dive.Address.Depth);
            report.Record("enlargement (powers of ten)", -dive.Address.LogUnit / Math.Log(10));
            dive.ReturnToStart();
            Assert.Equal((0, 0.0), (dive.Address.Depth, dive.Address.LogUnit));
            // As FractalAddressTests demand. Rounding deep down is a fraction of the unit there, so that the last steps outside decide.
            var error = Near.Difference(frameToCamera, dive.Address.FrameToCamera) / size;
            report.Require("place after the return by depth (of the distance)", error, 1e-9, () => $"depth {depth}", depth);
        }
    }

    private void CheckFrames(string name, int[] depths, [CallerMemberName] string test = "")
    {
        using var report = new StabilityReport(output, name, test);
        Light[] lights = [new AmbientLight(Colour.White, 0.1), new DirectionalLight(new(0.3, -0.5, 0.9), Colour.White, 0.9)];
        var item = new SceneObject("a.fdo", Transformation.Identity) { Colour = Colour.White };
        var model = new FractalModel(FractalAddressTests.CreateInfinite(name)) { SourcePath = "a.fdo" };
        var scene = new LoadedScene(new() { Background = Colour.Black, Lights = [.. lights] }, [new(item, model)]);
        var drawable = DrawableScene.Prepare(scene, Settings);
        using var context = new SharedContext();
        using var renderer = new SceneRenderer(context, drawable);
        using var frame = new FrameRenderer(context);
        var dive = new FractalDive(drawable.Objects[0].Model.LodHierarchy!, 0, AffineMap.Identity, Direction);
        var first = At(40);
        Assert.True(RenderScenes.CountDifferent(first, (0, 0, 0, 255)) > 500, "the frame shows nothing");
        foreach (var depth in depths)
        {
            var (mean, share) = RenderScenes.Difference(first, At(depth));
            Assert.Equal(depth, dive.Address.Depth);
            report.Require(
                "image beside that at depth 40: share of pixels that differ by more than 8 of 255", share, 0, () => $"depth {depth}");
            report.Require("image beside that at depth 40: mean difference of 255", mean, 0, () => $"depth {depth}");
        }

        PixelImage At(int depth)
        {
            dive.GoToDepth(depth, 0.2);
            // A position within the bounds of the sub-fractal and outside those of its children: the same at each level.
            dive.ConvergeTo(1.5 * Direction);
            var camera = new Camera(
                dive.Address.WorldPosition(AffineMap.Identity), CameraFraming.LookRotation(dive.LocateTarget(Vector.Zero)), 50);
            var zoom = new DeepZoom(0, dive.Address.CollectRoots(MaxAncestors), dive.Address.LogUnit);
            var view = new View(camera, Projection.Perspective) { FixedClipPlanes = (0.02, 1e12), DeepZoom = zoom };
            frame.Draw(renderer, view, Width, Height, Settings);
            context.Resources.ThrowOnError("drawing");
            return frame.Capture();
        }
    }
}
