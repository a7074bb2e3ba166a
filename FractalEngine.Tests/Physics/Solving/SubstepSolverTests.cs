using FractalEngine.Core.Generation;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics;
using FractalEngine.Core.Physics.Bodies;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Core.Physics.Solving;
using FractalEngine.Tests.Physics.Islands;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Physics.Solving;

/// <summary>What the substeps of an island of balls do with their velocities and ways.</summary>
public sealed class SubstepSolverTests
{
    private const double Step = 1 / 60.0;

    [Fact]
    public void Solve_OfTwoThatMeet_StopsTheirApproachAndKeepsTheirMomentum() => Seeded.Run(50, random =>
    {
        var (mass, other) = (random.Between(0.1, 10), random.Between(0.1, 10));
        var setup = Create(
            Ball(Vector.Zero) with { Mass = mass, Velocity = random.Vector(0.5) + Vector.I },
            Ball(Vector.I) with { Mass = other, Velocity = random.Vector(0.5) - Vector.I });
        var momentum = (mass * setup.Bodies[0].Velocity) + (other * setup.Bodies[1].Velocity);
        Assert.True(Solve(setup));
        Near.Equal(momentum, (mass * setup.Bodies[0].Velocity) + (other * setup.Bodies[1].Velocity), 1e-12);
        // Without friction, what is across the line of centres stays as it was, but for the turn of that line.
        Assert.InRange(setup.Bodies[1].Velocity.X - setup.Bodies[0].Velocity.X, -0.2, 0.2);
        Assert.True((setup.Bodies[0].Target - setup.Bodies[1].Target).Length() >= 1 - 5e-4);
    });

    [Fact]
    public void Solve_OfTwoInFlight_LeadsAlongTheirParabolas()
    {
        var setup = Create(Ball(Vector.Zero), Ball(Vector.I));
        Assert.True(Solve(setup, acceleration: new(0, -6, 0)));
        foreach (var body in setup.Bodies)
        {
            Near.Equal(body.Position - (3 * Step * Step * Vector.J), body.Target, 1e-16);
            Near.Equal(new(0, -6 * Step, 0), body.Velocity, 1e-16);
        }
    }

    [Fact]
    public void Solve_OfAPlane_EndsAllWaysBeforeIt() => Seeded.Run(50, random =>
    {
        var normal = random.Direction();
        var velocity = random.Vector(5) - (random.Between(0, 30) * normal);
        var setup = Create(
            Ball(Vector.Zero) with { Velocity = velocity, Friction = random.NextDouble() }, Ball(Vector.I) with { Velocity = velocity });
        foreach (var body in setup.Bodies)
        {
            // Both lie on the plane, or above it.
            var height = Math.Max(0, Vector.Dot(body.Position, normal));
            var contact = new Contact(body.Position - ((0.5 + height) * normal), 0.5, Vector.Zero, Contact.NoBody, IsFlat: true);
            body.NearSurfaces.Add(in contact, normal, body.Contacts, body.Position);
        }

        Assert.True(setup.TryGroup(Step));
        _ = Solve(setup, acceleration: new(0, -9.8, 0));
        Assert.All(setup.Bodies, body =>
        {
            var foot = Vector.Dot(body.NearSurfaces[0].Point, normal);
            Assert.True(Vector.Dot(body.Target, normal) - foot >= 0.5 * (1 - 1e-12), $"{body.Target}");
        });
    });

    [Fact]
    public void Solve_OfBallsWithinEachOther_PushesThemApartByTheirMassesAndGivesNoSpeed()
    {
        var setup = Create(Ball(Vector.Zero) with { Mass = 3 }, Ball(0.9 * Vector.I));
        Assert.True(Solve(setup));
        Assert.InRange((setup.Bodies[1].Target - setup.Bodies[0].Target).Length(), 0.98, 1);
        Near.Equal(new(0.9, 0, 0), (3 * setup.Bodies[0].Target) + setup.Bodies[1].Target, 1e-14);
        Assert.All(setup.Bodies, static body => Assert.Equal(Vector.Zero, body.Velocity));
    }

    /// <summary>Each alone would start within the other, and could go nowhere.</summary>
    [Theory]
    [InlineData(0.9, 1)]
    [InlineData(1, 0)]
    public void Islands_OfBallsThatSeparate_AreThoseThatOverlap(double distance, int islands)
    {
        var setup = new GraphOfBodies(Ball(Vector.Zero), Ball(distance * Vector.I) with { Velocity = 5 * Vector.I });
        Assert.True(setup.TryGroup(Step));
        Assert.Equal(islands, setup.Islands.All.Count);
    }

    [Fact]
    public void Solve_OfBallsAtOnePlace_StaysFinite()
    {
        var setup = Create(Ball(Vector.Zero), Ball(Vector.Zero));
        _ = Solve(setup, acceleration: new(0, -9.8, 0));
        Assert.All(setup.Bodies, static body => Assert.True(body.Target.IsFinite() && body.Velocity.IsFinite()));
    }

    /// <summary>A ball between two others, that goes where no contact was foreseen: it is pushed back from what stands there.</summary>
    [Fact]
    public void Solve_OfOneThatIsThrownFarther_KeepsItOutOfOthers()
    {
        // Thrown by a heavy one at 60 units a second, over the light one's 20.
        var setup = Create(
            Ball(Vector.Zero) with { Mass = 1000, Velocity = 60 * Vector.I }, Ball(Vector.I) with { Velocity = 20 * Vector.I },
            Ball(2.4 * Vector.I) with { Mass = 1000, Velocity = 20 * Vector.I });
        _ = Solve(setup);
        Assert.True((setup.Bodies[2].Target - setup.Bodies[1].Target).Length() >= 0.95);
    }

    /// <summary>The energy of motion and height of a heap grows by what pushes lift it at most, whatever the heap.</summary>
    [Fact]
    public void Steps_OfHeaps_GainNoEnergy() => Seeded.Run(4, random =>
    {
        var world = new PhysicsWorld(new PhysicsSettings { SleepSpeed = 0 });
        world.AddStatic(Shapes.Box(new(new(-50, -1, -50), new(50, 0, 50))));
        var friction = random.Next(2) * random.NextDouble();
        world.AddRange(Enumerable.Range(0, 150).Select(i => new BodyDescription(
            new Vector(i % 5 * 0.9, 0.6 + (i / 25 * 0.9), i / 5 % 5 * 0.9) + random.Vector(0.05), random.Between(0.2, 0.45))
        {
            Friction = friction, Mass = random.Between(0.2, 5), Velocity = random.Vector(3), RollingFriction = random.Next(2) * 0.1,
        }));
        var energy = Energy(world);
        world.Run(120, () =>
        {
            var after = Energy(world);
            Assert.True(after <= energy * (1 + 1e-3), $"from {energy:R} to {after:R} in step {world.StepCount}");
            energy = after;
        });
    });

    private static double Energy(PhysicsWorld world) => world.Bodies.Sum(static body =>
        body.KineticEnergy + (9.8 * body.Description.Mass * (body.Position.Y - body.Radius)));

    private static BodyDescription Ball(Vector position) => new(position, 0.5);

    private static GraphOfBodies Create(params BodyDescription[] balls)
    {
        var setup = new GraphOfBodies(balls);
        Assert.True(setup.TryGroup(Step));
        return setup;
    }

    private static bool Solve(GraphOfBodies setup, Vector acceleration = default)
    {
        setup.Bodies.ForEach(body => body.FreeAcceleration = acceleration);
        var cache = new ImpulseCache();
        cache.Reserve(64);
        var solver = new SubstepSolver(setup.Bodies, cache, maxThreads: 1);
        return solver.Solve(setup.Islands, setup.Islands.All[0], Step);
    }
}
