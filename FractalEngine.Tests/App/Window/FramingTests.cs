using FractalEngine.Core.Fractals;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Core.Views;
using FractalEngine.Core.Visibility.Levels;
using FractalEngine.Render.Cameras;
using FractalEngine.Tests.Render;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.App.Window;

/// <summary>Tests that a camera which frames a scene follows it as it grows, and that wheels of any speed stay before surfaces.</summary>
public class FramingTests
{
    private const double Aspect = 1.3;

    [Theory]
    [InlineData(1.1, false)]
    [InlineData(0.9, false)]
    [InlineData(2, true)]
    [InlineData(0.3, true)]
    public void FollowShape_OfAFramingCamera_KeepsTheSceneInView(double scale, bool follows)
    {
        var camera = CreateCamera(1);
        var grown = CreateCamera(scale);
        grown.Restore(camera.State);
        var before = grown.Camera;
        grown.FollowShape(Aspect);
        Assert.Equal(follows, before != grown.Camera);
        Assert.Equal(before.Rotation, grown.Camera.Rotation);
        if (follows)
        {
            Near.Equal(CameraFraming.FrameScene(before, SceneOf(scale), Aspect).Position, grown.Camera.Position, 1e-9);
        }
    }

    [Fact]
    public void FollowShape_AfterAMove_LeavesTheViewAsItIs()
    {
        var camera = CreateCamera(1);
        camera.Orbit(0.2, 0.1);
        var grown = CreateCamera(5);
        grown.Restore(camera.State);
        var before = grown.Camera;
        grown.FollowShape(Aspect);
        Assert.Equal(before, grown.Camera);
        // Framed by hand, it is followed again.
        grown.FrameScene(Aspect);
        var larger = CreateCamera(20);
        larger.Restore(grown.State);
        larger.FollowShape(Aspect);
        Assert.NotEqual(grown.Camera, larger.Camera);
    }

    /// <summary>A panel that makes the frame narrower alone is no reason to move.</summary>
    [Fact]
    public void FollowShape_OfTheSameShapeInAnotherFrame_LeavesTheViewAsItIs()
    {
        var camera = CreateCamera(1);
        var same = CreateCamera(1);
        same.Restore(camera.State);
        same.FollowShape(0.4);
        Assert.Equal(camera.Camera, same.Camera);
    }

    /// <summary>
    /// In a solid without a smallest level a camera that is led through the surface would be within sub-fractals without end. Wheels tell
    /// of several notches at once.
    /// </summary>
    [Theory]
    [InlineData(1)]
    [InlineData(4)]
    [InlineData(8)]
    [InlineData(30)]
    public void Zoom_OfManyNotchesAtOnce_StaysBeforeASolid(int notchesAtOnce) => Seeded.Run(20, random =>
    {
        var camera = CreateSolid();
        var (right, up) = (0.0, 0.0);
        for (var notches = 0; notches < 240; notches += notchesAtOnce)
        {
            if (random.Next(10) == 0)
            {
                (right, up) = (random.Between(-1.2, 1.2), random.Between(-1, 1));
            }

            camera.Zoom(Math.Pow(0.88, notchesAtOnce), right, up);
            Assert.InRange(camera.Depth, 0, 200);
        }
    });

    [Fact]
    public void Zoom_OfManyNotchesAtOnce_IsThatOfOneAfterTheOther()
    {
        var (one, many) = (CreateCamera(1), CreateCamera(1));
        for (var i = 0; i < 6; i++)
        {
            one.Zoom(0.88, 0.1, 0.2);
        }

        many.Zoom(Math.Pow(0.88, 6), 0.1, 0.2);
        Near.Equal(one.Camera.Position, many.Camera.Position, 1e-12);
        Assert.Equal(one.FocusDistance, many.FocusDistance, 1e-12);
    }

    [Fact]
    public void Move_IntoASolidWithoutASmallestLevel_EndsAtItsPrecision()
    {
        var camera = CreateSolid();
        camera.Move(new(0, 0, 1.9));
        Assert.InRange(camera.Depth, 20, 60);
    }

    private static FlyingCamera CreateCamera(double scale)
    {
        var scene = SceneOf(scale);
        var camera = CameraFraming.Default(scene, Aspect);
        return new(scene.Bounds, camera, Projection.Perspective, null, scene: scene, framedAspect: Aspect);
    }

    private static LoadedScene SceneOf(double scale) => LoadedScene.Of(new()
    {
        Objects = [new(new MeshModel(RenderScenes.Cube(1)) { SourcePath = "cube.obj" })
            { Placement = Transformation.Identity with { Scale = scale * Vector.One } }],
    });

    /// <summary>All of a cube of side 1, down to no end.</summary>
    private static FlyingCamera CreateSolid()
    {
        Transformation[] maps = [.. from x in (double[])[-0.25, 0.25]
            from y in (double[])[-0.25, 0.25]
            from z in (double[])[-0.25, 0.25]
            select Transformation.At(new(x, y, z), 0.5)];
        var fractal = Fractal.Of(RenderScenes.Cube(0.5)).Repeat(maps, null);
        var scene = LoadedScene.Of(new() { Objects = [new(fractal)] });
        var camera = CameraFraming.Default(scene, Aspect);
        return new(
            scene.Bounds, camera, Projection.Perspective, null, new(0, LodHierarchy.Build(fractal), AffineMap.Identity), scene, Aspect);
    }
}
