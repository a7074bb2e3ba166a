using FractalEngine.Core;
using FractalEngine.Core.Colliders;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Generation;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics;
using FractalEngine.Core.Physics.Bodies;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Robustness;

/// <summary>Worlds of numbers that no one means: they move, or are refused, and never hold an undefined number.</summary>
public sealed class PhysicsRangeTests
{
    private static readonly double[] ExtremeNumbers =
    [
        0, 1, -1, 1e-3, -7, 100, 1e10, -1e20, 1e100, 1e150, -1e160, 1e300, double.MaxValue, double.Epsilon, 1e-300, 1e-160, 1e-20,
        double.NaN, double.PositiveInfinity, double.NegativeInfinity,
    ];

    [Fact]
    public void Step_OfAnyNumbers_MovesOrRefuses()
    {
        var moved = 0;
        Seeded.Run(120, random =>
        {
            try
            {
                var world = CreateWorld(new ExtremeRandom(random));
                for (var step = 0; step < 3; step++)
                {
                    world.Step();
                    Assert.All(world.Bodies, body => Assert.True(body.Position.IsFinite() && body.Velocity.IsFinite()));
                    Assert.True(world.Character is not { } character || character.Position.IsFinite());
                    moved++;
                }
            }
            catch (Exception exception) when (exception is ArgumentException or FractalEngineException)
            {
                // Said before the step, or where a distance is no double.
            }
            catch (InvalidOperationException exception)
            {
                Assert.Contains("has left the range of a double", exception.Message, StringComparison.Ordinal);
            }
        });
        // Most worlds have one number at least that is refused.
        Assert.True(moved > 60, $"{moved} steps");
    }

    [Theory]
    [InlineData(1e-15, false)]
    [InlineData(1e-11, true)]
    public void Require_OfABodySmallerThanItsPlaceIsRounded_Refuses(double radius, bool isAccepted)
    {
        var world = new PhysicsWorld();
        _ = world.Add(new(new(3, 2, 1), radius) { Name = "dust" });
        _ = world.Add(new(Vector.Zero, 1e-30));
        var exception = Record.Exception(() => PhysicsLimits.Require(world.Bodies));
        Assert.Equal(isAccepted, exception is null);
        if (exception is not null)
        {
            Assert.Equal("the radius of body dust is below the limit of physics, 1e-12 of its coordinates", exception.Message);
        }
    }

    [Theory]
    [InlineData(200, 0, true)]
    [InlineData(201, 0, false)]
    [InlineData(10_000, 0.2, false)]
    public void Require_OfBodiesThatOverlapEachOther_RefusesMoreThanTwentyThousandPairs(int count, double halfSize, bool isAccepted) =>
        CheckOverlaps(Enumerable.Range(0, count).Select(i => new BodyDescription(new Random(i).Vector(halfSize), 0.05)), isAccepted);

    /// <summary>A hundred and fifty balls on an axis, each of which touches all of a thousand dots on a circle about it.</summary>
    [Theory]
    [InlineData(1, true)]
    [InlineData(1.01, false)]
    public void Require_OfBodiesThatTouch_CountsThoseThatOverlap(double growth, bool isAccepted)
    {
        const double Dot = 1e-3;
        var dots = Enumerable.Range(0, 1_000).Select(static i => Math.Tau / 1_000 * i)
            .Select(angle => new BodyDescription(new(Math.Cos(angle), Math.Sin(angle), 0), growth * Dot));
        var balls = Enumerable.Range(0, 150).Select(static i => 0.01 * i)
            .Select(static height => new BodyDescription(new(0, 0, height), double.Hypot(1, height) - Dot));
        CheckOverlaps(dots.Concat(balls), isAccepted);
    }

    [Fact]
    public void Step_OfABodyJustLargeEnough_LiesOnTheGround()
    {
        var world = new PhysicsWorld();
        _ = world.AddStatic(Shapes.Box(new(new(-50, 0, -50), new(50, 1, 50))));
        var radius = 2 * PhysicsLimits.MinRadiusShare;
        var body = world.Add(new(new(0.3, 1 + (10 * radius), 0.2), radius));
        PhysicsLimits.Require(world.Bodies);
        for (var step = 0; step < 60; step++)
        {
            world.Step();
        }

        Assert.InRange(body.Position.Y - 1, 0.99 * radius, 1.01 * radius);
    }

    private static PhysicsWorld CreateWorld(ExtremeRandom random)
    {
        var world = new PhysicsWorld();
        world.Gravity = random.Chance(0.5) ? random.Vector() : world.Gravity;
        var mesh = Shapes.Cube();
        var fractal = Fractal.Of(mesh).Repeat([Samples.MoveAndScale(1, 0, 0, 0.5)], 5);
        Transformation placement = new(
            random.Vector(), Vector.Zero, random.Chance(0.5) ? Vector.One : random.Magnitude() * Vector.One);
        _ = random.Chance(0.5) ? world.AddStatic(mesh, placement) : world.AddStatic(fractal, placement);
        for (var i = 0; i < 2; i++)
        {
            world.Add(new(random.Vector(), random.Magnitude())
            {
                Velocity = random.Vector(),
                Mass = random.Chance(0.7) ? 1 : random.Magnitude(),
                Friction = random.Magnitude(),
                Shrinkage = random.Chance(0.7) ? 0 : random.Magnitude(),
                Collider = random.Chance(0.5) ? ColliderKind.Exact : ColliderKind.Simple,
            });
        }

        if (random.Chance(0.3))
        {
            world.AddCharacter(new(random.Vector(), 0.3, 1.8)).IsActive = true;
        }

        if (random.Chance(0.2))
        {
            world.SetForce(world.Bodies[0], random.Vector());
        }

        return world;
    }

    /// <summary>Numbers of which some are extreme.</summary>
    private sealed class ExtremeRandom(Random random)
    {
        public bool Chance(double probability) => random.NextDouble() < probability;

        public double Number() => Chance(0.9) ? random.Between(-2, 2) : ExtremeNumbers[random.Next(ExtremeNumbers.Length)];

        public double Magnitude() => Math.Abs(Number());

        public Vector Vector() => new(Number(), Number(), Number());
    }

    private static void CheckOverlaps(IEnumerable<BodyDescription> descriptions, bool isAccepted)
    {
        var bodies = descriptions.Select(static (description, i) => new Body(description, i)).ToArray();
        var exception = Record.Exception(() => PhysicsLimits.Require(bodies));
        Assert.Equal(isAccepted, exception is null);
        if (exception is not null)
        {
            Assert.Equal("the bodies overlap each other in more than the limit of 20000 pairs", exception.Message);
        }
    }
}
