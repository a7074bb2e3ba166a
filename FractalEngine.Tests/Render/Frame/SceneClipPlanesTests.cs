using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Core.Scenes.Lights;
using FractalEngine.Render.Drawables;
using FractalEngine.Render.Frame;
using FractalEngine.Render.Views;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Render.Frame;

/// <summary>What is near the camera and in view is drawn, however far away something else is.</summary>
[Collection(GlTests.Name)]
public sealed class SceneClipPlanesTests
{
    private const double Aspect = 4.0 / 3;

    /// <summary>Squares of the size 1 at depth 5, and others beside, behind and above the view, or before the camera.</summary>
    [SkippableTheory]
    [InlineData(0, 1e5, 1e5)]
    [InlineData(0, 1e9, 1e9)]
    [InlineData(0, 1e20, 1e20)]
    [InlineData(0, 0, 1e6)]
    [InlineData(0, 0, 1e12)]
    [InlineData(1e7, 0, 1e3)]
    [InlineData(0, 1e5, -1e5)]
    public void Draw_WithAnotherObjectFarAway_ShowsTheNearOne(double x, double y, double z)
    {
        var alone = Draw([Samples.Move(0, 0, 0)]);
        var both = Draw([Samples.Move(0, 0, 0), Samples.Move(x, y, z)]);
        Assert.Equal((255, 255, 255, 255), both[100, 75]);
        Assert.True(RenderScenes.Difference(alone, both) is { Share: < 0.001 });
    }

    /// <summary>A wall as far as it is wide still ends where it ends, and the near square hides it.</summary>
    [SkippableTheory]
    [InlineData(1e5)]
    [InlineData(1e7)]
    [InlineData(1e10)]
    public void Draw_WithALargeObjectFarAway_ShowsBothInTheirOrder(double distance)
    {
        var scene = RenderScenes.Scene(
            new Scene { Background = Colour.Black, Lights = [RenderScenes.FullLight] },
            (RenderScenes.Model(RenderScenes.Square(1)), Samples.Move(0, 0, 0), new Colour(1, 0, 0)),
            (RenderScenes.Model(RenderScenes.Square(1)), Samples.MoveAndScale(0, 0, distance, 0.3 * distance), new Colour(0, 0, 1)));
        var image = RenderScenes.Draw(scene, RenderScenes.FrontView);
        Assert.Equal((255, 0, 0, 255), image[100, 75]);
        Assert.Equal((0, 0, 255, 255), image[68, 75]);
        Assert.Equal((0, 0, 0, 255), image[5, 5]);
    }

    /// <summary>Lines reach as far as the scene's bounds, though no object in view does.</summary>
    [Fact]
    public void Of_WithLines_HasTheFarPlaneOfTheBounds()
    {
        var view = RenderScenes.FrontView;
        BoundingBox near = new(new(-0.5, -0.5, -4.5), new(0.5, 0.5, -4.4)), far = new(new(-1, 1e5, -1), new(1, 1e5 + 1, 1e5));
        var bounds = BoundingBox.Union(near, far);
        var (_, farOfBounds) = view.ClipPlanes(bounds);
        var lines = SceneClipPlanes.Of(view, Aspect, bounds, true, [near, far], []);
        var none = SceneClipPlanes.Of(view, Aspect, bounds, false, [near, far], []);
        Assert.Equal(farOfBounds, lines.Far);
        Assert.InRange(none.Far, 0.6, 4);
        Assert.InRange(lines.Near, 0.1, 0.5);
    }

    /// <summary>The depths of a light's map are told apart as well as without the distant object.</summary>
    [SkippableFact]
    public void Draw_WithShadowsAndAnotherObjectFarAway_ShowsTheSameShadows()
    {
        (Model, Transformation, Colour?)[] near =
        [
            (RenderScenes.Model(RenderScenes.Cube(0.5)), Samples.Move(0, 0.5, 0), Colour.White),
            (RenderScenes.Model(RenderScenes.Cube(4)), Samples.Move(0, -4, 0), Colour.White),
        ];
        var scene = new Scene { Background = Colour.Black, Lights = [new DirectionalLight(new(1, -1, 0.5), Colour.White, 0.8)] };
        var view = new View(new(new(0, 3, -8), new(-0.3, 0, 0), 60), Projection.Perspective);
        var alone = RenderScenes.Draw(RenderScenes.Scene(scene, near), view);
        var both = RenderScenes.Draw(
            RenderScenes.Scene(scene, [.. near, (RenderScenes.Model(RenderScenes.Cube(0.5)), Samples.Move(0, 1e6, 1e6), Colour.White)]),
            view);
        Assert.True(RenderScenes.Difference(alone, both) is { Share: < 0.002 });
    }

    [Fact]
    public void Of_ObjectsWithinTheBaseRatio_AreThoseOfTheBounds()
    {
        BoundingBox near = new(new(-1, -1, -1), new(1, 1, 1));
        BoundingBox far = new(new(-1, -1, 3e4), new(1, 1, 3.1e4));
        Assert.Equal(RenderScenes.FrontView.ClipPlanes(BoundingBox.Union(near, far)), Planes(RenderScenes.FrontView, near, far));

        // The camera is within the first box, whose own planes those are.
        var inside = RenderScenes.FrontView with { Camera = Camera.Default with { Position = Vector.Zero } };
        Assert.Equal(inside.ClipPlanes(near), Planes(inside, near));
    }

    [Fact]
    public void Of_AGroundBelowTheCamera_ReachToTheObjectOnIt()
    {
        BoundingBox ground = new(new(-1e6, -1, -1e6), new(1e6, -0.9, 1e6));
        BoundingBox cube = new(new(-0.5, -0.5, 0), new(0.5, 0.5, 1));
        var (near, far) = Planes(RenderScenes.FrontView, ground, cube);
        // The ground is 0.9 below: before the lower corners of the frame it is not nearer than that times the cosine.
        Assert.InRange(near, 0.25, 0.9);
        Assert.InRange(far, 1e6, 2.2e6);
    }

    [Fact]
    public void Of_AnObjectThatMovesALittle_Stay()
    {
        BoundingBox distant = new(new(-1, 1e6, 1e6), new(1, 1e6, 1e6));
        var planes = Enumerable.Range(0, 20).Select(i =>
        {
            var shift = (0.2 + (0.01 * i)) * Vector.K;
            return Planes(RenderScenes.FrontView, distant, new(shift - Vector.One, shift + Vector.One));
        });
        Assert.Single(planes.Distinct());
    }

    [Fact]
    public void Of_ASphereBesideTheObjects_ReachToIt()
    {
        BoundingBox distant = new(new(-1, 1e6, 1e6), new(1, 1e6, 1e6));
        SphereInstance[] spheres = [new(Vector.Zero, 0.5)];
        var bounds = BoundingBox.Union(distant, new(-Vector.One, Vector.One));
        var (near, far) = SceneClipPlanes.Of(RenderScenes.FrontView, Aspect, bounds, false, [distant], spheres);
        Assert.True(near < 4.5 && far is > 5.5 and < 1000, $"{near} to {far}");
    }

    [Theory]
    [InlineData(Projection.Perspective)]
    [InlineData(Projection.Orthographic)]
    public void Of_ABodyThatHasLeftTheBounds_FollowItInStepsWhileItIsSeen(Projection projection)
    {
        var view = RenderScenes.FrontView with { Projection = projection, OrthographicHeight = 5 };
        BoundingBox bounds = new(-Vector.One, Vector.One);
        (double Near, double Far) PlanesWith(Vector centre, double half) => SceneClipPlanes.Of(
            view, Aspect, bounds, false, [bounds, new(centre - (half * Vector.One), centre + (half * Vector.One))], [], grid: 2);

        // The farther side moves from z = 22.1 to 23.9, within a step that ends at 24: 29 from the camera.
        var planes = Enumerable.Range(0, 10).Select(i => PlanesWith((20.6 + (0.2 * i)) * Vector.K, 1.5)).Distinct();
        Assert.InRange(Assert.Single(planes).Far, 29, 30);
        Assert.InRange(PlanesWith(-3.5 * Vector.K, 0.5).Near, 0, 1);

        var alone = view.ClipPlanes(bounds);
        Assert.Equal(alone, PlanesWith(new(0, -1000, 20), 1));
        Assert.Equal(alone, PlanesWith(20 * Vector.K, 1e-6));
        Assert.Equal(alone, PlanesWith(0.5 * Vector.K, 0.5));
    }

    private static (double Near, double Far) Planes(View view, params BoundingBox[] boxes) =>
        SceneClipPlanes.Of(view, Aspect, boxes.Aggregate(BoundingBox.Union), false, boxes, []);

    private static Core.Images.PixelImage Draw(Transformation[] placements) => RenderScenes.Draw(
        RenderScenes.Scene(
            new Scene { Background = Colour.Black, Lights = [RenderScenes.FullLight] },
            [.. placements.Select(placement => (RenderScenes.Model(RenderScenes.Square(1)), placement, (Colour?)Colour.White))]),
        RenderScenes.FrontView);
}
