using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Physics;

/// <summary>Friction, damping and forces against their formulas.</summary>
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
        // It begins with nothing known of the slope and falls a touch, 1e-9 of the radius at most, before friction acts: that takes
        // √(2e-9/9.8) seconds.
        const double Late = 1.5e-5;
        Near.Equal(world.Time * acceleration * down, body.Velocity, 9.8 * Late);
        Near.Equal(body.Description.Position + (0.5 * world.Time * world.Time * acceleration * down), body.Position,
            (9.8 * Late * world.Time) + (1e-6 * body.Radius));
    });

    [Fact]
    public void Sliding_WithFriction_StopsAfterTheBrakingDistance() => Seeded.Run(40, random =>
    {
        var (speed, friction) = (random.Between(0.5, 5), random.Between(0.1, 1));
        var world = TestWorlds.Create(TestWorlds.Gravity, random.Between(0.002, 0.05), TestWorlds.Place(PhysicsMeshes.FloorMesh()));
        var body = world.Add(new(new(0, 0.5, 0), 0.5) { Velocity = new(speed, 0, 0), Friction = friction });
        var time = speed / (friction * 9.8);
        world.Run((int)(time / world.Settings.TimeStep) + 60);
        Assert.Equal(Vector.Zero, body.Velocity);
        Near.Equal(speed * time / 2, body.Position.X, 1e-5 * speed);
    });

    [Fact]
    public void Bounce_WithFriction_TakesFrictionTimesTheImpulse() => Seeded.Run(100, random =>
    {
        var (friction, restitution, along, into) = (random.Between(0, 0.5), random.NextDouble(), random.Between(0, 10),
            random.Between(1, 5));
        var world = TestWorlds.Create(Vector.Zero, 0.01, TestWorlds.Place(PhysicsMeshes.FloorMesh()));
        var body = world.Add(new(new(0, 1, 0), 0.5) { Velocity = new(along, -into, 0), Friction = friction, Restitution = restitution });
        world.Run(60);
        // Coulomb: at most what stops it. 1e-10 of the radius in the direction of the normal.
        Near.Equal(new(Math.Max(0, along - (friction * (1 + restitution) * into)), restitution * into, 0), body.Velocity, 1e-8);
    });

    [Theory]
    [InlineData(1e-3)]
    [InlineData(0.1)]
    public void Damping_WithoutForces_IsExponential(double step) => Seeded.Run(20, random =>
    {
        var (rate, velocity) = (random.Between(0.01, 5), random.Vector(10));
        var world = TestWorlds.Create(Vector.Zero, step);
        var body = world.Add(new(Vector.Zero, 0.5) { Velocity = velocity, Damping = rate });
        // A rounding a step.
        world.Run(300, () => Near.Equal(Math.Exp(-rate * world.Time) * velocity, body.Velocity, 1e-12));
        // From v to v·exp(−ct): between the way at the faster and at the slower speed of each step.
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
        // g/c; the order of damping and falling within a step leaves c·step of it.
        Near.Equal(new(0, -9.8 / Rate, 0), body.Velocity, 9.8 / Rate * Rate * Step);
    }

    [Fact]
    public void Force_OnABody_AcceleratesByForceOverMass() => Seeded.Run(50, random =>
    {
        var (gravity, force, mass, velocity) = (random.Vector(10), random.Vector(20), Math.Pow(10, random.Between(-1, 2)),
            random.Vector(5));
        var world = TestWorlds.Create(gravity, random.Between(0.001, 0.1));
        var body = world.Add(new(Vector.Zero, 0.5) { Mass = mass, Velocity = velocity });
        world.SetForce(body, force);
        world.Run(50);
        var time = world.Time;
        // A rounding a step.
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
            // A body so slow would fall asleep.
            var world = TestWorlds.Create(TestWorlds.Gravity, new PhysicsSettings { TimeStep = 0.01, SleepSpeed = 0 },
                TestWorlds.Place(PhysicsMeshes.FloorMesh()));
            var body = world.Add(new(new(0, 0.5, 0), 0.5) { Mass = 3, Friction = 0.4 });
            world.Run(10);
            world.SetForce(body, new(force, 0, 0));
            world.Run(100);
            Assert.Equal(isMoving, body.Velocity.X > 0);
            Near.Equal(isMoving ? 0.01 * 0.4 * 9.8 : 0, body.Velocity.X, 1e-6);
        }
    }

    private static Body CreateOnSlope(Random random, double angle, double friction, out PhysicsWorld world, out Vector down)
    {
        var (heading, radius) = (random.Between(0, 2 * Math.PI), random.Between(0.1, 1));
        var normal = new Vector(Math.Sin(angle) * Math.Cos(heading), Math.Cos(angle), Math.Sin(angle) * Math.Sin(heading));
        down = new(Math.Cos(angle) * Math.Cos(heading), -Math.Sin(angle), Math.Cos(angle) * Math.Sin(heading));
        world = TestWorlds.Create(TestWorlds.Gravity, random.Between(0.002, 0.02),
            TestWorlds.Place(PhysicsMeshes.FromTriangles(PhysicsMeshes.PlaneTriangle(Vector.Zero, normal))));
        return world.Add(new(radius * normal, radius) { Friction = friction, Mass = random.Between(0.1, 10) });
    }
}
