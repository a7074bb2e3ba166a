using FractalEngine.Core.Generation;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Physics;

/// <summary>Steps whose length the caller gives.</summary>
public sealed class StepLengthTests
{
    private static readonly Mesh Floor = Shapes.Box(new(new(-10, -1, -10), new(10, 0, 10)));

    public static TheoryData<double> InvalidLengths =>
        [double.NaN, double.PositiveInfinity, double.NegativeInfinity, 0, -0.0, -1 / 60.0];

    [Theory]
    [MemberData(nameof(InvalidLengths))]
    public void Step_OfAnInvalidLength_IsRefusedAndChangesNothing(double seconds)
    {
        var world = CreateWorld();
        world.Run(5);
        var (hash, time) = (world.StateHash, world.Time);
        Assert.Equal("seconds", Assert.Throws<ArgumentOutOfRangeException>(() => world.Step(seconds)).ParamName);
        Assert.Equal((5L, time, hash), (world.StepCount, world.Time, world.StateHash));
    }

    [Fact]
    public void Step_OfTheDefaultLength_GivesTheSameBitsAsStep()
    {
        var (world, other) = (CreateWorld(), CreateWorld());
        for (var step = 0; step < 200; step++)
        {
            world.Step();
            other.Step(world.Settings.TimeStep);
            Assert.Equal((world.StateHash, world.Time), (other.StateHash, other.Time));
        }

        Assert.Equal(200 * world.Settings.TimeStep, world.Time);
    }

    [Fact]
    public void Step_OfRandomLengths_IsDeterministicAndAddsUpTheTime() => Seeded.Run(5, random =>
    {
        double[] lengths = [.. Enumerable.Range(0, 300).Select(_ => Math.Pow(10, random.Between(-4, -1)))];
        var worlds = new[] { CreateWorld(), CreateWorld() };
        foreach (var world in worlds)
        {
            var sum = 0.0;
            foreach (var length in lengths)
            {
                world.Step(length);
                sum += length;
                // Three hundred additions, each rounded.
                Near.Equal(sum, world.Time, 1e-12);
            }

            Assert.Equal(lengths.Length, world.StepCount);
        }

        Assert.Equal(worlds[0].StateHash, worlds[1].StateHash);
    });

    [Fact]
    public void Time_OfManyEqualSteps_LosesNothingToRounding()
    {
        var world = new PhysicsWorld();
        for (var step = 0; step < 36_000; step++)
        {
            world.Step(0.1);
        }

        Assert.Equal(3600, world.Time);
        world.Step(0.25);
        Assert.Equal(3600.25, world.Time);
    }

    [Fact]
    public void FreeFlight_AtStepsOfAnyLength_IsTheParabola() => Seeded.Run(20, random =>
    {
        var (velocity, gravity) = (random.Vector(10), random.Vector(10));
        var world = new PhysicsWorld { Gravity = gravity };
        var body = world.AddSphere(Vector.Zero, 0.1, velocity: velocity);
        for (var step = 0; step < 200; step++)
        {
            world.Step(Math.Pow(10, random.Between(-4, -1)));
            // Some hundred roundings of numbers up to a thousand.
            Near.Equal((world.Time * velocity) + (0.5 * world.Time * world.Time * gravity), body.Position, 1e-10);
        }
    });

    /// <summary>The default restitution threshold is half the speed that gravity adds in a step.</summary>
    [Theory]
    [InlineData(1 / 60.0)]
    [InlineData(1 / 240.0)]
    [InlineData(1 / 1000.0)]
    public void Bounce_AroundTheThreshold_FollowsTheLengthOfTheStep(double length)
    {
        const double Gravity = 9.8;
        var threshold = 0.5 * Gravity * length;
        foreach (var (factor, rise) in new[] { (0.9, 0), (1.1, 0.05 * Gravity * length * length) })
        {
            var world = new PhysicsWorld();
            world.AddStatic(Floor);
            var body = world.AddSphere(new(0, 0.5, 0), 0.5, restitution: 1, velocity: new(0, -factor * threshold, 0));
            world.Step(length);
            // It hits the floor at once. If it bounces, it rises by (0.5·1.1 − 0.5)·g·t² during the step.
            Near.Equal(0.5 + rise, body.Position.Y, 1e-8);
        }
    }

    [Theory]
    [InlineData(1 / 30.0)]
    [InlineData(1 / 60.0)]
    [InlineData(1 / 1000.0)]
    public void Sleep_AtStepsOfAnyLength_BeginsAfterTheSameTime(double length)
    {
        var world = new PhysicsWorld();
        world.AddStatic(Floor);
        var body = world.AddSphere(new(0, 0.5, 0), 0.5);
        while (!body.IsAsleep && world.Time < 2)
        {
            world.Step(length);
        }

        // One step more, until the contact is found, and one for the last fraction.
        Assert.InRange(world.Time, world.Settings.TimeBeforeSleep - 1e-9, world.Settings.TimeBeforeSleep + (2.5 * length));
    }

    [Fact]
    public void Character_AtStepsOfAnyLength_WalksAsFast() => Seeded.Run(5, random =>
    {
        var world = new PhysicsWorld();
        world.AddStatic(Floor);
        var character = world.AddCharacter(new(new(-8, 0.9, 0), 0.3, 1.8));
        character.IsActive = true;
        world.Run(10);
        Assert.True(character.IsGrounded);
        var (start, startTime) = (character.Position, world.Time);
        character.MoveInput = Vector.I;
        for (var step = 0; step < 100; step++)
        {
            world.Step(Math.Pow(10, random.Between(-3, -1.5)));
        }

        Near.Equal(start + ((world.Time - startTime) * 4.5 * Vector.I), character.Position, 1e-7);
    });

    [Fact]
    public void Advance_AfterSteps_GoesOnWithEqualSteps()
    {
        var world = new PhysicsWorld(new PhysicsSettings { TimeStep = 0.25 });
        world.Step(1);
        Assert.Equal(2, world.Advance(0.625));
        Assert.Equal((3L, 1.5, 0.5), (world.StepCount, world.Time, world.InterpolationAlpha));
    }

    private static PhysicsWorld CreateWorld()
    {
        var world = new PhysicsWorld();
        world.AddStatic(Floor);
        world.AddStatic(Shapes.Cube(), Transformation.Identity with { Rotation = new(10, 20, 30), Position = new(0.3, 1, 0.2) });
        for (var i = 0; i < 6; i++)
        {
            world.AddSphere(new(0.3 * i, 2 + (0.4 * i), 0.1 * i), 0.15, 0.1 * i, friction: 0.1 * i, damping: 0.02 * i);
        }

        return world;
    }
}
