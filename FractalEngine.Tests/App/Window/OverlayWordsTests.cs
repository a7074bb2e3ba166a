using FractalEngine.App.Window.Drawing;
using FractalEngine.App.Window.Simulation;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Generation;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Core.Views;
using FractalEngine.Render.Ui.Painting;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.App.Window;

/// <summary>Tests what a window says, and that its panels find their places.</summary>
public class OverlayWordsTests
{
    private static readonly TimeSpan Now = TimeSpan.Zero;
    private static readonly Mesh Floor = Shapes.Box(new(new(-10, -1, -10), new(10, 0, 10)));

    [Theory]
    [InlineData(700, 400)]
    [InlineData(1400, 800)]
    [InlineData(1280, 720)]
    [InlineData(640, 480)]
    public void Panels_OfKeysStatusAndMessages_FitAndDoNotOverlap(int width, int height)
    {
        var overlay = new WindowOverlay();
        overlay.PhysicsStatus = "1 body, 1 awake · collider: each body's own\nlast step: 1,234 face tests, 5,678 bound tests, 0.12 ms";
        overlay.ShowMessage("collider: hierarchy, with a message that is as long as such messages get", Now);
        AssertApart(overlay, width, height);
        overlay.ShowMessage(new string('x', 60), Now);
        AssertApart(overlay, width, height);
        overlay.Error = "scene.sdo:2:12: error: unexpected 'x', expected a number\n  c (2, 1.5, x) (0.3, 0.6, 0) 60\n             ^";
        AssertApart(overlay, width, height);
    }

    [Theory]
    [InlineData(0, 0, 0, Projection.Perspective, "front, perspective")]
    [InlineData(1, 0, 0, Projection.Orthographic, "right, orthographic")]
    [InlineData(0, 1, 0, Projection.Perspective, "top, perspective")]
    [InlineData(1, 1, 1, Projection.Perspective, "perspective")]
    public void ViewName_OfACamera_NamesDirectionAndProjection(double x, double y, double z, Projection projection, string expected)
    {
        var from = new Vector(x, y, z);
        var camera = Camera.Default with { Rotation = CameraFraming.LookRotation(from == Vector.Zero ? Vector.K : -from) };
        Assert.Equal(expected, ViewName.Of(camera, projection, 0, -0.0));
        Assert.Equal(
            expected, ViewName.Of(camera with { Handedness = Handedness.Right }, projection, 0, 0));
        Assert.Equal($"{expected} · depth 12, 10^5.7 times", ViewName.Of(camera, projection, 12, 5.72));
    }

    [Theory]
    [InlineData(-0.0, "1 times")]
    [InlineData(0.5, "3.16 times")]
    [InlineData(300.04, "10^300.0 times")]
    public void Magnification_OfALogarithm_IsReadable(double log10, string expected) =>
        Assert.Equal(expected, ViewName.Magnification(log10));

    [Fact]
    public void FaceCount_OfCoincidingInstances_CountsDifferentOnes()
    {
        var step = Samples.Move(1, 0, 0);
        // 2^48 chains lead to 49 places.
        var fractal = Fractal.Of(Shapes.Cube()).Repeat([Transformation.Identity, step], 48);
        Assert.Equal("588 faces", FaceCountText.Of(LoadedScene.Of(new() { Objects = [new SceneObject(fractal)] })));
        Assert.Equal("0 faces", FaceCountText.Of(LoadedScene.Of(new())));
    }

    [Fact]
    public void DropSphere_FromAnywhere_IsInView() => Seeded.Run(50, random =>
    {
        var world = new PhysicsWorld(new Scene { Objects = [new SceneObject(Floor)] });
        var from = new Vector(random.Between(-9, 9), random.Between(1, 8), random.Between(-9, 9));
        var camera = new Camera(from, CameraFraming.LookRotation(new Vector(random.Between(-3, 3), 0, random.Between(-3, 3)) - from), 50);
        Assert.Equal("dropped a ball", BodySpawner.DropSphere(world, 28, camera));
        var ball = Assert.Single(world.Bodies);
        var (right, up, forward) = camera.ToCameraSpace(ball.Position);
        Assert.InRange(forward, ball.Radius, 30);
        Near.Equal(Vector.Zero, new(right, up, 0), 1e-9);
        // It is before the floor, and not in it.
        Assert.True(ball.Position.Y >= ball.Radius, $"{ball.Position}, radius {ball.Radius}");
    });

    [Fact]
    public void DropSphere_StraightAtAFace_IsJustBeforeIt()
    {
        for (var i = 0; i < 50; i++)
        {
            // A step towards the face ends at the wanted distance, but for rounding.
            var world = new PhysicsWorld(new Scene { Objects = [new SceneObject(Shapes.Cube())] });
            var camera = new Camera(new(0, 0, -8 - (i / 7.0)), Vector.Zero, 60);
            BodySpawner.DropSphere(world, 5.2, camera);
            var ball = Assert.Single(world.Bodies);
            Assert.InRange(-ball.Position.Z, 0.5 + ball.Radius, 1);
        }
    }

    /// <summary>No ball begins within another one, and beside all objects it falls beside their middle.</summary>
    [Fact]
    public void DropSphere_TowardsABallOrBesideAll_IsBeforeTheBallOrBesideTheMiddle()
    {
        var world = new PhysicsWorld(new Scene { Objects = [new SceneObject(Shapes.Cube())] });
        var camera = new Camera(new(0, 0, -8), Vector.Zero, 60);
        world.Add(new(new(0, 0, -3), 0.25));
        BodySpawner.DropSphere(world, 5.2, camera);
        var ball = world.Bodies[^1];
        Assert.InRange(ball.Position.Z, -4, -3.25 - ball.Radius);
        BodySpawner.DropSphere(world, 5.2, camera with { Position = new(2, 1, -8) });
        Near.Equal(new(2, 1, 0), world.Bodies[^1].Position, 1e-12);
    }

    [Fact]
    public void IsRunning_AtSpeedZero_IsFalse()
    {
        using var physics = new ScenePhysics(LoadedScene.Of(new() { Objects = [new SceneObject(Floor)] }), static () => { });
        physics.WhenReady(world => BodySpawner.DropSphere(world, physics.SceneExtent, Camera.Default with { Position = new(0, 2, 0) }));
        Assert.True(physics.IsRunning);
        physics.Speed = 0;
        Assert.False(physics.IsRunning);
    }

    [Fact]
    public void HasGround_OfAPlayer_TellsFloorFromVoid()
    {
        var world = new PhysicsWorld(new Scene { Objects = [new SceneObject(Floor)] });
        world.AddCharacter(new(new(2, 5, 3), 0.3, 1.6));
        Assert.True(BodySpawner.HasGround(world));
        world.AddCharacter(new(new(20, 5, 3), 0.3, 1.6));
        Assert.False(BodySpawner.HasGround(world));
        world.AddCharacter(new(new(2, -5, 3), 0.3, 1.6));
        Assert.False(BodySpawner.HasGround(world));
    }

    [Fact]
    public void HasMovers_OfAScene_IsTrueOnceABallWasDropped()
    {
        using var physics = new ScenePhysics(LoadedScene.Of(new() { Objects = [new SceneObject(Floor)] }), static () => { });
        Assert.False(physics.HasMovers);
        // What stands still needs no world, until something is asked of it.
        Assert.Null(physics.World);
        physics.WhenReady(world => BodySpawner.DropSphere(world, physics.SceneExtent, Camera.Default with { Position = new(0, 2, 0) }));
        Assert.True(physics.HasMovers);
    }

    private static void AssertApart(WindowOverlay overlay, int width, int height)
    {
        var layout = OverlayLayout.Create(overlay.Panels, new(0, 0, width, height));
        var panels = layout.Quads.Where(static quad => quad.Glyph < 0).ToArray();
        Assert.Equal(overlay.Panels.Count, panels.Length);
        foreach (var panel in panels)
        {
            Assert.True(
                panel.X >= 0 && panel.Y >= 0 && panel.X + panel.Width <= width && panel.Y + panel.Height <= height, $"{panel} is cut off");
            Assert.DoesNotContain(panels, other => other != panel && panel.X < other.X + other.Width && other.X < panel.X + panel.Width
                && panel.Y < other.Y + other.Height && other.Y < panel.Y + panel.Height);
        }
    }
}
