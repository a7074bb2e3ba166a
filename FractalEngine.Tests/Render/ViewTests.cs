using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Render;

namespace FractalEngine.Tests.Render;

public sealed class ViewTests
{
    private static readonly BoundingBox UnitBox = new(-Vector.One, Vector.One);

    [Fact]
    public void Project_PointOnTheAxis_IsTheMiddleOfTheFrame() =>
        Assert.Equal((160.0, 120.0, 5.0), RenderScenes.FrontView.Project(Vector.Zero, 320, 240));

    [Fact]
    public void Project_PointBehindThePerspectiveCamera_IsNowhere() =>
        Assert.Null(RenderScenes.FrontView.Project(new(0, 0, -6), 320, 240));

    [Fact]
    public void Project_UpperEdgeOfTheAngleOfView_IsTheUpperEdgeOfTheFrame()
    {
        var found = RenderScenes.FrontView.Project(new(0, 5 * Math.Tan(Math.PI / 6), 0), 320, 240)!.Value;
        Assert.Equal(0, found.Y, 1e-9);
    }

    [Fact]
    public void ClipPlanes_SceneBeforeTheCamera_EncloseItWithAMargin()
    {
        var (near, far) = RenderScenes.FrontView.ClipPlanes(UnitBox);
        Assert.InRange(near, 3.9, 4);
        Assert.InRange(far, 6, 6.1);
    }

    [Fact]
    public void ClipPlanes_CameraInsideTheScene_KeepABoundedRatio()
    {
        var view = new View(Camera.Default with { Position = Vector.Zero }, Projection.Perspective);
        var (near, far) = view.ClipPlanes(UnitBox);
        Assert.True(near > 0);
        Assert.Equal(1e4, far / near, 1e-6);
    }

    [Fact]
    public void ClipPlanes_OfTheScene_AreTaken()
    {
        var view = RenderScenes.FrontView with { Clip = (2, 3) };
        Assert.Equal((2.0, 3.0), view.ClipPlanes(UnitBox));
    }

    [Theory]
    [InlineData(Projection.Perspective)]
    [InlineData(Projection.Orthographic)]
    public void ClipPlanes_EmptyOrInfiniteOrBehind_ArePositiveAndOrdered(Projection projection)
    {
        var view = new View(Camera.Default, projection);
        var infinite = new BoundingBox(double.NegativeInfinity * Vector.One, double.PositiveInfinity * Vector.One);
        var behind = new BoundingBox(new(-1, -1, -20), new(1, 1, -10));
        foreach (var (near, far) in (IEnumerable<(double, double)>)
            [view.ClipPlanes(BoundingBox.Empty), view.ClipPlanes(infinite), view.ClipPlanes(behind)])
        {
            Assert.True(near > 0 && far > near && double.IsFinite(far));
        }
    }

    [Fact]
    public void Of_OrthographicScene_ShowsWhatPerspectiveShowsAtItsMiddle()
    {
        var scene = RenderScenes.Scene(
            new Scene { Projection = Projection.Orthographic, Camera = Camera.Default },
            (RenderScenes.Model(RenderScenes.Cube(1)), RenderScenes.TranslatedTo(0, 0, 3), null));
        Assert.Equal(2 * Math.Tan(Math.PI / 6) * 8, View.Of(scene, 1.5).OrthographicHeight, 1e-12);
    }

    [Fact]
    public void Of_OrthographicSceneBehindTheCamera_HasAPositiveHeight()
    {
        var scene = RenderScenes.Scene(
            new Scene { Projection = Projection.Orthographic, Camera = Camera.Default },
            (RenderScenes.Model(RenderScenes.Cube(1)), RenderScenes.TranslatedTo(0, 0, -30), null));
        Assert.True(View.Of(scene, 1.5).OrthographicHeight > 0);
    }

    [Theory]
    [InlineData(1.0, 300, 100, 100, 0, 100, 100)]
    [InlineData(2.0, 100, 100, 0, 25, 100, 50)]
    [InlineData(1e9, 100, 100, 0, 49, 100, 1)]
    public void Viewport_FixedAspect_IsTheLargestMiddlePart(double aspect, int width, int height, int x, int y, int shownWidth,
    int shownHeight) =>
        Assert.Equal((x, y, shownWidth, shownHeight), (RenderScenes.FrontView with { Aspect = aspect }).Viewport(width, height));
}
