using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Render.Views;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Render.Views;

public sealed class ViewTests
{
    private static readonly BoundingBox UnitBox = new(-Vector.One, Vector.One);

    [Fact]
    public void Project_PointOnTheAxis_IsTheCentreOfTheFrame() =>
        Assert.Equal((160.0, 120.0, 5.0), RenderScenes.FrontView.Project(Vector.Zero, 320, 240));

    [Fact]
    public void Project_PointBehindThePerspectiveCamera_IsNull() =>
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
    public void ClipPlanes_Fixed_AreTaken()
    {
        var view = RenderScenes.FrontView with { FixedClipPlanes = (2, 3) };
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
    public void Of_OrthographicScene_HasTheHeightOfPerspectiveAtItsCentre()
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
    public void Viewport_FixedAspect_IsTheLargestCentredPart(
        double aspect, int width, int height, int x, int y, int viewportWidth, int viewportHeight) =>
        Assert.Equal((x, y, viewportWidth, viewportHeight), (RenderScenes.FrontView with { Aspect = aspect }).Viewport(width, height));

    [Theory]
    [InlineData(Projection.Perspective)]
    [InlineData(Projection.Orthographic)]
    public void MayIntersectFrustum_BoxThatReachesIntoTheFrame_IsTrue(Projection projection) => Seeded.RunMost(300, random =>
    {
        var view = new View(new(random.Vector(3), random.Vector(3), 20 + (100 * random.NextDouble())), projection)
        {
            OrthographicHeight = 1 + (5 * random.NextDouble()),
        };
        var box = BoundingBox.Empty.Including(random.Vector(8)).Including(random.Vector(8));
        var isInFrame = false;
        for (var i = 0; i < 20; i++)
        {
            var point = box.Minimum + box.Size.Stretch(new(random.NextDouble(), random.NextDouble(), random.NextDouble()));
            if (view.Project(point, 300, 200) is var (x, y, depth) && depth > 0 && x is > 0 and < 300 && y is > 0 and < 200)
            {
                Assert.True(view.MayIntersectFrustum(box, 1.5), $"{point} of {box}");
                isInFrame = true;
            }
        }

        // Most boxes lie behind the camera or beside the frame, or reach into it by too little.
        return isInFrame;
    }, minShare: 0.25);
}
