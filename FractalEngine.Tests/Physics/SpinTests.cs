using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics;
using FractalEngine.Core.Physics.Bodies;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Physics;

/// <summary>Balls that roll, slide and spin, against their formulas.</summary>
public class SpinTests
{
    // Relative to the result.
    private const double Tolerance = 1e-5;

    private static readonly double Sine = Math.Sin(20 * Math.PI / 180);
    private static readonly double Cosine = Math.Cos(20 * Math.PI / 180);

    [Theory]
    [InlineData(0.4, 0.5)]
    [InlineData(2.0 / 3, 0.5)]
    [InlineData(0.4, 3)]
    public void Slope_WithEnoughFriction_LetsABallRoll(double inertia, double friction)
    {
        var body = CreateOnSlope(friction, out var world, 0.5, inertia: inertia);
        world.Run(60);
        var speed = 9.8 * Sine / (1 + inertia);
        Near.Equal(speed * new Vector(Cosine, -Sine, 0), body.Velocity, Tolerance * speed);
        Near.Equal(speed / 0.5, body.AngularVelocity.Length(), Tolerance * speed / 0.5);
        // 2.394 for a solid ball.
        Near.Equal(inertia == 0.4 ? 2.394 : speed, body.Velocity.Length(), 1e-3);
    }

    [Fact]
    public void Slope_WithLittleFriction_LetsABallSlideAndTurn()
    {
        const double Friction = 0.05;
        var body = CreateOnSlope(Friction, out var world, 0.5);
        world.Run(60);
        var speed = 9.8 * (Sine - (Friction * Cosine));
        Near.Equal(speed, body.Velocity.Length(), 2e-5 * speed);
        Near.Equal(Friction * 9.8 * Cosine / (0.4 * 0.5), body.AngularVelocity.Length(), 2e-5 * 9.8);
    }

    [Fact]
    public void Slope_BelowTheAngleOfRollingFriction_HoldsABall()
    {
        var body = CreateOnSlope(0.5, out var world, 0.5, rolling: 1.01 * Sine / Cosine);
        world.Run(120);
        Near.Equal(body.Description.Position, body.Position, 1e-6);
        body = CreateOnSlope(0.5, out world, 0.5, rolling: 0.5 * Sine / Cosine);
        world.Run(60);
        Near.Equal(0.5 * 9.8 * Sine / 1.4, body.Velocity.Length(), 1e-4);
    }

    [Fact]
    public void Sliding_BecomesRollingWithFiveSeventhsOfTheSpeed()
    {
        const double Speed = 5, Friction = 0.3;
        var body = CreateOnFloor(Friction, out var world, new(Speed, 0, 0));
        world.Run(300);
        var slideTime = 2 * Speed / (7 * Friction * 9.8);
        var distance = (Speed * slideTime) - (0.5 * Friction * 9.8 * slideTime * slideTime) + (5 * Speed / 7 * (5 - slideTime));
        Near.Equal(new(5 * Speed / 7, 0, 0), body.Velocity, Tolerance * Speed);
        Near.Equal(distance, body.Position.X, Tolerance * distance);
        Near.Equal(18.20, distance, 0.01);
        // In left-handed space, a ball that rolls to +x turns +y towards +x.
        Near.Equal(new(0, 0, -5 * Speed / 7 / 0.5), body.AngularVelocity, Tolerance * 2 * Speed);
    }

    [Fact]
    public void Bounce_WithEnoughFriction_StopsTheSlip()
    {
        var world = TestWorlds.Create(Vector.Zero, 0.01, TestWorlds.Place(PhysicsMeshes.FloorMesh()));
        var body = world.Add(new(new(0, 1, 0), 0.5) { Velocity = new(5, -3, 0), Restitution = 0.5, Friction = 2 });
        world.Run(60);
        Near.Equal(new(25 / 7.0, 1.5, 0), body.Velocity, Tolerance * 5);
        Near.Equal(new(0, 0, -25 / 7.0 / 0.5), body.AngularVelocity, Tolerance * 5);
    }

    [Fact]
    public void Spin_OnAFloor_EndsBySpinningFriction()
    {
        const double Spinning = 0.1;
        var world = TestWorlds.Create(TestWorlds.Gravity, 1 / 60.0, TestWorlds.Place(PhysicsMeshes.FloorMesh()));
        var body = world.Add(new(new(0, 0.5, 0), 0.5) { AngularVelocity = new(0, 3, 0), Friction = 0.5, SpinningFriction = Spinning });
        world.Run(10);
        // Torque 0.1·m·g·r over the inertia 0.4·m·r².
        Near.Equal(3 - (Spinning * 9.8 / (0.4 * 0.5) * world.Time), body.AngularVelocity.Y, 1e-3);
        world.Run(120);
        Assert.Equal(Vector.Zero, body.AngularVelocity);
    }

    [Fact]
    public void Rolling_TurnsTheBodyByItsWay()
    {
        var body = CreateOnFloor(0.5, out var world, new(1, 0, 0), new(0, 0, -2));
        world.Run(60);
        // One radian for each radius of the way.
        Near.Equal(new(0, 0, -2), body.Orientation.RotationVector, 1e-6);
        Near.Equal(new(Math.Cos(2), -Math.Sin(2), 0), body.InterpolatedMap(1).Linear * Vector.I, 1e-6);
    }

    [Fact]
    public void LockedBody_NeverTurns()
    {
        var body = CreateOnFloor(0.5, out var world, new(1, 0, 0), new(1, 2, 3), isLocked: true);
        world.Run(60);
        Assert.Equal(Vector.Zero, body.AngularVelocity);
        Assert.Equal(Orientation.Identity, body.Orientation);
    }

    private static Body CreateOnFloor(
        double friction, out PhysicsWorld world, Vector velocity, Vector spin = default, bool isLocked = false)
    {
        world = TestWorlds.Create(TestWorlds.Gravity, 1 / 60.0, TestWorlds.Place(PhysicsMeshes.FloorMesh()));
        return world.Add(new(new(0, 0.5, 0), 0.5)
        {
            Velocity = velocity, AngularVelocity = spin, Friction = friction, IsRotationLocked = isLocked,
        });
    }

    private static Body CreateOnSlope(double friction, out PhysicsWorld world, double radius, double inertia = 0.4, double rolling = 0)
    {
        var normal = new Vector(Sine, Cosine, 0);
        var slope = PhysicsMeshes.FromTriangles(PhysicsMeshes.PlaneTriangle(Vector.Zero, normal));
        world = TestWorlds.Create(TestWorlds.Gravity, 1 / 60.0, TestWorlds.Place(slope));
        return world.Add(new(radius * normal, radius) { Friction = friction, InertiaFactor = inertia, RollingFriction = rolling });
    }
}
