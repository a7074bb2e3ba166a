using FractalEngine.Core;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Parsing.Exports;
using FractalEngine.Tests.Render;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Parsing.Exports;

/// <summary>Tests how coordinates of scenes become those of files.</summary>
public class ExportFrameTests
{
    private static readonly Vector Point = new(1, 2, 3);

    /// <summary>What the screen shows: x to the right, y up, and the third number towards the viewer.</summary>
    private static Vector OnScreen(Handedness handedness, Vector v) => new(v.X, v.Y, handedness == Handedness.Right ? v.Z : -v.Z);

    [Theory]
    [InlineData(Handedness.Left)]
    [InlineData(Handedness.Right)]
    public void Frames_OfFormats_ShowWhatTheScreenShows(Handedness shown)
    {
        var screen = OnScreen(shown, Point);
        Assert.Equal(screen, Map(ExportFrame.Right, shown));
        // With z up, y points away from the viewer.
        Assert.Equal(new(screen.X, -screen.Z, screen.Y), Map(ExportFrame.Printing, shown));
        Assert.Equal(Point, Map(ExportFrame.Unchanged, shown));
        Assert.Equal(screen, Map(ExportFrame.Unchanged, shown, new() { Handedness = Handedness.Right }));
        Assert.Equal(
            OnScreen(Handedness.Left, screen), Map(ExportFrame.Right, shown, new() { Handedness = Handedness.Left }));
        Assert.Equal(screen, Map(ExportFrame.Printing, shown, new() { Up = UpAxis.Y }));
    }

    [Fact]
    public void Lengths_OfUnitsAndHeights_Scale()
    {
        Assert.Equal(10 * Point, Map(ExportFrame.Unchanged, Handedness.Left, new() { UnitLength = 10 }));
        // The scene is 2 high.
        Assert.Equal(40 * Point, Map(ExportFrame.Unchanged, Handedness.Left, new() { Height = 80 }));
    }

    [Fact]
    public void Height_OfWhatIsFlat_IsRefused()
    {
        var flat = RenderScenes.Model(Samples.Triangle.Transform(static v => new(v.X, 0, v.Y)));
        var scene = RenderScenes.Scene(new(), (flat, Transformation.Identity, null));
        Assert.Equal(
            "the scene has no height that could be scaled to the one wanted",
            Assert.Throws<FractalEngineException>(() => ExportFrame.Right.From(scene, new() { Height = 1 })).Message);
    }

    private static Vector Map(ExportFrame frame, Handedness shown, ExportSettings? settings = null) => frame.From(
        RenderScenes.Scene(
            new() { Handedness = shown }, (RenderScenes.Model(RenderScenes.Cube(1)), Transformation.Identity, null)),
        settings ?? new()) * Point;
}
