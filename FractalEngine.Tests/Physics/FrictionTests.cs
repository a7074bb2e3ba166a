using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics;
using FractalEngine.Core.Physics.Bodies;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Physics;

/// <summary>Checks friction, damping and forces against their formulas, for bodies that do not turn.</summary>
public class FrictionTests
{
    [Fact]
    public void Slope_BelowTheAngleOfFriction_HoldsTheBody() => Seeded.Run(40, random =>
    {
        var angle = random.Between(1, 60) * Math.PI / 180;
        var body = CreateOnSlope(random, angle, Math.Tan(angle) * random.Between(1.01, 3), out var world, out _);
        world.Step();
        var position = body.Position;
        // It begins within rounding of the surface and may drop by that much once.
        Near.Equal(body.Description.Position, position, 1e-6 * body.Radius);
        world.Run(500, () => Near.Equal(position, body.Position, 1e-9));
    });

    [Fact]
    public void Slope_AboveTheAngleOfFriction_AcceleratesByWhatIsLeft() => Seeded.Run(40, random =>
    {
        var angle = random.Between(10, 80) * Math.PI / 180;
        var friction = Math.Tan(angle) * random.Between(0, 0.95);
        var body = CreateOnSlope(random, angle, friction, out var world, out var down);
        var acceleration = 9.8 * (Math.Sin(angle) - (friction * Math.Cos(angle)));
        world.Run(100);
        // It begins without a contact, and falls by the touch tolerance before friction acts: 1e-9 of the radius in √(2e-9/9.8) seconds.
        const double Late = 1.5e-5;
        Near.Equal(world.Time * acceleration * down, body.Velocity, 9.8 * Late);
        Near.Equal(body.Description.Position + (0.5 * world.Time * world.Time * acceleration * down), body.Position,
            (9.8 * Late * world.Time) + (1e-6 * body.Radius));
    });

    [Fact]
    public void Sliding_WithFriction_StopsAfterTheBrakingDistance() => Seeded.Run(40, random =>
    {
        var speed = random.Between(0.5, 5);
        var friction = random.Between(0.1, 1);
        var world = TestWorlds.Create(TestWorlds.Gravity, random.Between(0.002, 0.05), TestWorlds.Place(PhysicsMeshes.FloorMesh()));
        var body = world.Add(new(new(0, 0.5, 0), 0.5)
        {
            Velocity = new(speed, 0, 0), Friction = friction, IsRotationLocked = true,
        });
        var time = speed / (friction * 9.8);
        world.Run((int)(time / world.Settings.TimeStep) + 60);
        Assert.Equal(Vector.Zero, body.Velocity);
        Near.Equal(speed * time / 2, body.Position.X, 1e-5 * speed);
    });

    [Fact]
    public void Bounce_WithFriction_TakesFrictionTimesTheImpulse() => Seeded.Run(100, random =>
    {
        var friction = random.Between(0, 0.5);
        var restitution = random.NextDouble();
        var along = random.Between(0, 10);
        var into = random.Between(1, 5);
        var world = TestWorlds.Create(Vector.Zero, 0.01, TestWorlds.Place(PhysicsMeshes.FloorMesh()));
        var body = world.Add(new(new(0, 1, 0), 0.5)
        {
            Restitution = restitution, Velocity = new(along, -into, 0), Friction = friction, IsRotationLocked = true,
        });
        world.Run(60);
        // Coulomb's friction stops the body at most. The impact is found to 1e-10 of the radius.
        Near.Equal(new(Math.Max(0, along - (friction * (1 + restitution) * into)), restitution * into, 0), body.Velocity, 1e-8);
    });

    [Theory]
    [InlineData(1e-3)]
    [InlineData(0.1)]
    public void Damping_WithoutForces_IsExponential(double step) => Seeded.Run(20, random =>
    {
        var rate = random.Between(0.01, 5);
        var velocity = random.Vector(10);
        var world = TestWorlds.Create(Vector.Zero, step);
        var body = world.Add(new(Vector.Zero, 0.5) { Velocity = velocity, Damping = rate });
        // One rounding in each step.
        world.Run(300, () => Near.Equal(Math.Exp(-rate * world.Time) * velocity, body.Velocity, 1e-12));
        // Speed falls from v to v·exp(−ct) within each step: the distance lies between those at either speed.
        var distance = (1 - Math.Exp(-rate * world.Time)) / rate * velocity.Length();
        Assert.InRange(body.Position.Length(), distance * Math.Exp(-rate * step), distance * Math.Exp(rate * step));
    });

    [Fact]
    public void Damping_InFreeFall_ReachesTheTerminalSpeed()
    {
        const double Rate = 2, Step = 1e-3;
        var world = TestWorlds.Create(TestWorlds.Gravity, Step);
        var body = world.Add(new(Vector.Zero, 0.5) { Damping = Rate });
        world.Run(10_000);
        // The terminal speed is g/c; the order of damping and falling within a step leaves a fraction c·step of it.
        Near.Equal(new(0, -9.8 / Rate, 0), body.Velocity, 9.8 / Rate * Rate * Step);
    }

    [Fact]
    public void Force_OnABody_AcceleratesByForceOverMass() => Seeded.Run(50, random =>
    {
        var gravity = random.Vector(10);
        var force = random.Vector(20);
        var mass = Math.Pow(10, random.Between(-1, 2));
        var velocity = random.Vector(5);
        var world = TestWorlds.Create(gravity, random.Between(0.001, 0.1));
        var body = world.Add(new(Vector.Zero, 0.5) { Mass = mass, Velocity = velocity });
        world.SetForce(body, force);
        world.Run(50);
        var time = world.Time;
        // One rounding in each step.
        Near.Equal(velocity + (time * (gravity + (force / mass))), body.Velocity, 1e-10);
        Near.Equal((time * velocity) + (0.5 * time * time * (gravity + (force / mass))), body.Position, 1e-9);
        world.SetForce(body, Vector.Zero);
        var before = body.Velocity;
        world.Run(10);
        Near.Equal(before + (10 * world.Settings.TimeStep * gravity), body.Velocity, 1e-10);
    });

    [Fact]
    public void Force_ThatPullsAgainstFriction_MovesAboveItsLimit()
    {
        foreach (var (force, isMoving) in new[] { (0.99 * 0.4 * 3 * 9.8, false), (1.01 * 0.4 * 3 * 9.8, true) })
        {
            // Without sleep, into which a body so slow would fall.
            var world = TestWorlds.Create(TestWorlds.Gravity, new PhysicsSettings { TimeStep = 0.01, SleepSpeed = 0 },
                TestWorlds.Place(PhysicsMeshes.FloorMesh()));
            var body = world.Add(new(new(0, 0.5, 0), 0.5) { Mass = 3, Friction = 0.4, IsRotationLocked = true });
            world.Run(10);
            world.SetForce(body, new(force, 0, 0));
            world.Run(100);
            Assert.Equal(isMoving, body.Velocity.X > 0);
            Near.Equal(isMoving ? 0.01 * 0.4 * 9.8 : 0, body.Velocity.X, 1e-6);
        }
    }

    private static Body CreateOnSlope(Random random, double angle, double friction, out PhysicsWorld world, out Vector down)
    {
        var heading = random.Between(0, 2 * Math.PI);
        var radius = random.Between(0.1, 1);
        var normal = new Vector(Math.Sin(angle) * Math.Cos(heading), Math.Cos(angle), Math.Sin(angle) * Math.Sin(heading));
        down = new(Math.Cos(angle) * Math.Cos(heading), -Math.Sin(angle), Math.Cos(angle) * Math.Sin(heading));
        var slope = PhysicsMeshes.FromTriangles(PhysicsMeshes.PlaneTriangle(Vector.Zero, normal));
        world = TestWorlds.Create(TestWorlds.Gravity, random.Between(0.002, 0.02), TestWorlds.Place(slope));
        return world.Add(new(radius * normal, radius)
        {
            Friction = friction, Mass = random.Between(0.1, 10), IsRotationLocked = true,
        });
    }
}
