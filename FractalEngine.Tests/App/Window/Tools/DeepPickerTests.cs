using FractalEngine.App.Window.Tools;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Core.Views;
using FractalEngine.Core.Visibility.Levels;
using FractalEngine.Render.Cameras;
using FractalEngine.Render.Views;
using FractalEngine.Tests.Support;
using FractalEngine.Tests.Visibility.Frames;

namespace FractalEngine.Tests.App.Window.Tools;

/// <summary>Tests what a click selects where world space is too coarse for the camera's place in a fractal.</summary>
public class DeepPickerTests
{
    private static readonly (int Width, int Height) Size = (320, 200);

    private static readonly Vector Corner = new(-1, 1, -1);
    private static readonly Vector Start = new(-3, 3, -3.2);

    [Theory]
    [InlineData(15)]
    [InlineData(40)]
    [InlineData(250)]
    public void PickDeep_OfAPixel_FindsTheInstanceAndTheLevelsAround(double log10Magnification) =>
        CheckPixels(log10Magnification, stride: 29);

    [Theory]
    [InlineData(15)]
    [InlineData(40)]
    [InlineData(250)]
    [Trait("Category", "Soak")]
    public void PickDeep_OfManyPixels_FindsTheInstanceAndTheLevelsAround(double log10Magnification) =>
        CheckPixels(log10Magnification, stride: 5);

    [Theory]
    [InlineData(15)]
    [InlineData(40)]
    public void PickDeep_AfterTheCameraHasMoved_KeepsItsPlace(double log10Magnification)
    {
        var dive = new Dive(log10Magnification);
        var selection = dive.Pick((160, 100))!;
        foreach (var step in (Vector[])[new(0.1, 0.05, 0.2), new(-0.4, 0.2, -0.8), new(3, 1, -7), new(-20, 4, -50), new(0, 0, -4000)])
        {
            var (expected, unit) = (dive.Point(selection), dive.Camera.Address!.LogUnit);
            dive.Camera.Move(step);
            var moved = Math.Exp(unit - dive.Camera.Address.LogUnit) * (expected - (dive.Camera.Pose.Camera.LocalAxes * step));
            Near.Equal(0, (moved - dive.Point(selection)).Length(), 1e-9 * (1 + moved.Length()));
        }
    }

    [Fact]
    public void PickDeep_SeenFromOutsideAgain_IsAtItsPointOfTheWorld()
    {
        // Where both frames are exact, they agree.
        var dive = new Dive(11.5);
        var selection = dive.Pick((160, 100))!;
        Assert.NotNull(selection.Viewpoint);
        dive.Camera.Reset();
        Assert.Equal(0, dive.Camera.Depth);
        var drawn = dive.Camera.MapToDrawnFrame(selection.Viewpoint, isDeep: false)!(selection.Point);
        Near.Equal(selection.WorldPoint, drawn, 1e-12);
        Assert.InRange((selection.WorldPoint - Corner).Length(), 0, 1e-3);
    }

    [Fact]
    public void MapToDrawnFrame_TooFarAway_IsNull()
    {
        var dive = new Dive(40);
        var selection = dive.Pick((160, 100))!;
        dive.Camera.Reset();
        Assert.Null(dive.Camera.MapToDrawnFrame(selection.Viewpoint, isDeep: false));
    }

    [Fact]
    public void Focus_OnADeepPoint_OrbitsAroundIt()
    {
        var dive = new Dive(40);
        var point = dive.Point(dive.Pick((100, 60))!);
        dive.Camera.FocusOn(point);
        Near.Equal(point.Length(), dive.Camera.FocusDistance, 1e-12);
        var focus = dive.Camera.FocusDistance * dive.Camera.Pose.Camera.LocalAxes.V3;
        Near.Equal(0, (focus - point).Length(), 1e-9 * point.Length());
    }

    [Fact]
    public void Measure_OfTwoDeepPoints_TellsTheLengthInSceneUnits()
    {
        var dive = new Dive(40);
        var (first, second) = (dive.Pick((150, 100))!, dive.Pick((170, 100))!);
        var tool = new MeasureTool();
        tool.Toggle();
        Assert.Equal("click the second point", tool.Click(first, dive.Scene));
        tool.Click(second, dive.Scene);
        var dimension = Assert.Single(tool.Dimensions);
        Assert.Matches(@"^\d(\.\d+)?E-4[0-2]$", dimension.LengthText);
        tool.Kind = MeasureKind.Objects;
        tool.Click(first, dive.Scene);
        Assert.Equal("so deep in a fractal, only points can be measured", tool.Click(second, dive.Scene));
    }

    [Fact]
    public void Measure_OfPointsSeenFromDifferentPlaces_IsInTheFrameOfTheSecond()
    {
        var dive = new Dive(40);
        var first = dive.Pick((150, 100))!;
        dive.Camera.Move(new(0.1, 0.05, -3));
        var second = dive.Pick((165, 100))!;
        var tool = new MeasureTool();
        tool.Toggle();
        tool.Click(first, dive.Scene);
        tool.Click(second, dive.Scene);
        var dimension = Assert.Single(tool.Dimensions);
        Assert.True((first.Point - dive.Point(first)).Length() > 0.1, "the camera has not moved");
        Near.Equal(dive.Point(first), dimension.From, 1e-9 * (1 + dimension.From.Length()));
        Near.Equal(dive.Point(second), dimension.To, 1e-9 * (1 + dimension.To.Length()));
    }

    [Fact]
    public void PickDeep_AfterAnotherSceneWasShown_PicksInTheNewOne()
    {
        var sponge = new Dive(15);
        var maps = from x in (double[])[-1, 1]
                   from y in (double[])[-1, 1]
                   from z in (double[])[-1, 1]
                   select Samples.MoveAndScale(2 / 3.0 * x, 2 / 3.0 * y, 2 / 3.0 * z, 1 / 3.0);
        var corners = new Dive(15, new(Samples.Repeated(null, [.. maps]).Description, CullingViews.Cube));
        var picker = new Picker();
        foreach (var dive in (Dive[])[sponge, corners, sponge])
        {
            var (expected, actual) = (dive.Pick((160, 100))!, dive.Pick((160, 100), picker)!);
            Assert.Equal(expected.Point, actual.Point);
            Assert.Equal(expected.Path.AsEnumerable(), actual.Path);
        }
    }

    [Fact]
    public void Text_OfADeepSelection_HasAllLevelsAndTheDistance()
    {
        var selection = new Dive(40).Pick((160, 100))!;
        Assert.Contains("instance: " + string.Join('.', selection.Path) + "\n", selection.ToText(), StringComparison.Ordinal);
        var facts = selection.Facts.ToDictionary(static fact => fact.Name, static fact => fact.Value);
        Assert.Contains("E-4", facts["distance"], StringComparison.Ordinal);
        Assert.StartsWith("…", facts["instance"], StringComparison.Ordinal);
    }

    [Theory]
    [InlineData(0.5, -1000, "2.5")]
    [InlineData(3, -2000000, "")]
    public void ScaledNumber_BelowTheSmallestDouble_HasAnExponent(double length, double logUnit, string start)
    {
        var text = ScaledNumber.Format(length, logUnit, 9);
        Assert.StartsWith(start, text, StringComparison.Ordinal);
        Assert.Matches(@"^\d(\.\d+)?E-\d+$", text);
    }

    /// <summary>Checks that each part around holds the point, and that the parts grow until they are too large to be told.</summary>
    private static void CheckPartsAround(Selection selection)
    {
        var (size, isTold) = (0.0, true);
        for (var depth = selection.Path.Length; depth >= 0; depth--, selection = selection.Up())
        {
            Assert.Equal(depth, selection.Depth);
            var (box, map) = selection.Outline;
            Assert.True(isTold || box.IsEmpty);
            isTold = !box.IsEmpty;
            if (isTold)
            {
                var bounds = box.Transform(map);
                // The smallest parts that a ray finds are as small as the rounding of its hit.
                var tolerance = 1e-9 * bounds.Diagonal + (1e-12 * selection.Hit!.Value.Distance);
                Assert.InRange(Math.Sqrt(bounds.DistanceSquared(selection.Point)), 0, tolerance);
                var outer = bounds.Diagonal;
                Assert.True(outer > size, $"level {depth}");
                size = outer;
            }
        }

        Assert.InRange(size, 1e12, 1e17);
        Assert.Same(selection, selection.Up());
    }

    /// <summary>A camera that has flown towards the corner of an infinite sponge.</summary>
    private static void CheckPixels(double log10Magnification, int stride)
    {
        var dive = new Dive(log10Magnification);
        var count = 0;
        for (var y = 5; y < Size.Height; y += stride)
        {
            for (var x = 5; x < Size.Width; x += stride)
            {
                if (dive.Pick((x, y)) is not { } selection)
                {
                    continue;
                }

                count++;
                // The levels of the camera, and those down to what doubles can tell from there.
                Assert.True(selection.Path.Length > dive.Camera.Depth - 5, $"only {selection.Path.Length} levels");
                Assert.All(selection.Path, static index => Assert.InRange(index, 0, 19));
                var (px, py, _) = dive.View.Project(selection.Point, Size.Width, Size.Height)!.Value;
                Near.Equal(new Vector(x, y, 0), new Vector(px, py, 0), 1e-6);
                CheckPartsAround(selection);
            }
        }

        // A sixth of all pixels.
        Assert.True(count * stride * stride > 10_140, $"only {count} pixels show the sponge");
    }

    private sealed class Dive
    {
        private readonly Picker _picker = new();

        public Dive(double log10Magnification, Fractal? fractal = null)
        {
            fractal ??= CullingViews.Menger(null);
            var hierarchy = LodHierarchy.Build(fractal);
            Scene = LoadedScene.Of(new() { Objects = [new SceneObject(fractal)] });
            Camera = new(
                Scene.Bounds, new(Start, CameraFraming.LookRotation(Corner - Start), 50), Projection.Perspective, null,
                new(0, hierarchy, AffineMap.Identity));
            for (var i = 0; Camera.Log10Magnification < log10Magnification; i++)
            {
                Assert.True(i < 20_000, $"only a magnification of 10^{Camera.Log10Magnification}");
                Camera.Zoom(0.9);
                // A direction misses what it was aimed at after some 16 digits.
                if (i % 50 == 49 && Camera.Depth > 0 && Pick((160.5, 100.5)) is { } ahead)
                {
                    Camera.FocusOn(Point(ahead));
                }
            }
        }

        public LoadedScene Scene { get; }

        public FlyingCamera Camera { get; }

        /// <summary>The view about the camera, in the unit of its address.</summary>
        public View View => Camera.WithDeepZoom(new(Camera.Pose.Camera, Projection.Perspective));

        public Selection? Pick((double X, double Y) pixel, Picker? picker = null) =>
            (picker ?? _picker).PickDeep(Scene, View, Camera.Address!, pixel, Size);

        /// <summary>The selected point about the present camera.</summary>
        public Vector Point(Selection selection) => Camera.ToCameraFrame(selection.Point, selection.Viewpoint)!.Value;
    }
}
