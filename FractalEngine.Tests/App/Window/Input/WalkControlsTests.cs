using FractalEngine.App.Window.Input;
using FractalEngine.Core.Generation;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Tests.Physics;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.App.Window.Input;

/// <summary>The gaze of a player on ground that turns.</summary>
public class WalkControlsTests
{
    [Theory]
    [InlineData(Handedness.Left, 1)]
    [InlineData(Handedness.Left, 0.25)]
    [InlineData(Handedness.Right, 1)]
    [InlineData(Handedness.Right, 0.25)]
    public void EyeCamera_OnATurntable_TurnsWithTheGround(Handedness handedness, double alpha)
    {
        var world = new PhysicsWorld();
        var turntable = world.AddStatic(Shapes.Cube(), new(new(0, -0.5, 0), Vector.Zero, new(20, 1, 20)));
        var walker = world.AddCharacter(new(new(3, 0.9, 0), 0.3, 1.8));
        walker.IsActive = true;
        turntable.SetMotion(Vector.Zero, new(0, 0.5, 0));
        var controls = new WalkControls { Direction = Camera.Default with { Handedness = handedness, Rotation = new(0.1, 0.4, 0) } };
        var (_, _, before) = controls.EyeCamera(walker, 1).LocalAxes;
        world.Run(90);
        var angle = walker.PreviousCarriedAngle + (alpha * (walker.CarriedAngle - walker.PreviousCarriedAngle));
        Assert.InRange(angle, 0.6, 0.8);
        var eye = controls.EyeCamera(walker, alpha);
        var (_, _, after) = eye.LocalAxes;
        // As the ground: x towards −z about y.
        Vector expected = new(
            (before.X * Math.Cos(angle)) + (before.Z * Math.Sin(angle)), before.Y,
            (before.Z * Math.Cos(angle)) - (before.X * Math.Sin(angle)));
        Near.Equal(expected, after, 1e-9);
        Near.Equal(expected, controls.Direction.LocalAxes.V3, 1e-9);
        var centre = walker.PreviousPosition + (alpha * (walker.Position - walker.PreviousPosition));
        Near.Equal(centre + (0.42 * 1.8 * Vector.J), eye.Position, 1e-12);
        // Asked again, it stays.
        Assert.Equal(eye, controls.EyeCamera(walker, alpha));
    }

    [Fact]
    public void Begin_OfAnotherWalk_LooksWhereTheCameraDoes()
    {
        var world = new PhysicsWorld();
        world.AddStatic(Shapes.Cube(), new(new(0, -0.5, 0), Vector.Zero, new(20, 1, 20))).SetMotion(Vector.Zero, new(0, 0.5, 0));
        var camera = Camera.Default with { Rotation = new(0.1, 0.4, 0) };
        var controls = new WalkControls();
        for (var walk = 0; walk < 2; walk++)
        {
            // A new player, as where the scene has none.
            var walker = world.AddCharacter(new(new(3, 0.9, 0), 0.3, 1.8));
            walker.IsActive = true;
            controls.Begin(camera, walker, 0.25);
            Assert.Equal(camera.Rotation, controls.EyeCamera(walker, 0.25).Rotation);
            world.Run(90);
            Assert.NotEqual(camera.Rotation, controls.EyeCamera(walker, 0.25).Rotation);
            // The same one again, as where the scene has it.
            controls.Begin(camera, walker, 0.25);
            Assert.Equal(camera.Rotation, controls.EyeCamera(walker, 0.25).Rotation);
        }
    }
}
