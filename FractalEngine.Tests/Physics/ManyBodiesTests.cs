using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Core.Physics.Rows;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Physics;

/// <summary>Many spheres that meet each other.</summary>
public class ManyBodiesTests
{
    // Relative to the smaller radius: no ball overlaps a surface, and those that fall among each other overlap by what can't be seen.
    private const double MaxOverlap = 1e-6;
    private const double MaxOverlapOfBalls = 0.05;

    [Fact]
    public void Spheres_PouredIntoABox_NeitherOverlapNorLeaveAndSleep() => CheckPoured(60, 900, 1);

    [Theory]
    [InlineData(1)]
    [InlineData(2)]
    [InlineData(3)]
    [Trait("Category", "Soak")]
    public void Spheres_PouredInNumbersIntoABox_NeitherOverlapNorLeaveAndSleep(int seed) => CheckPoured(200, 9000, seed);

    [Fact]
    public void Cloud_WithoutGravity_KeepsItsMomentum() => Seeded.Run(3, random =>
    {
        var world = TestWorlds.Create(Vector.Zero, 1 / 60.0);
        for (var i = 0; i < 64; i++)
        {
            var position = new Vector(i % 4, i / 4 % 4, i / 16) - (1.5 * Vector.One);
            world.Add(new(position, random.Between(0.1, 0.45))
            {
                Mass = random.Between(0.1, 10),
                // Towards the centre, so that they meet.
                Velocity = (-1 * position) + random.Vector(0.5),
                Restitution = random.NextDouble(),
                Friction = random.Next(2) * 0.3,
            });
        }

        var momentum = world.Momentum();
        var energy = world.Energy();
        world.Run(200, () =>
        {
            // Masses and speeds of some units, hundreds of impacts.
            Near.Equal(momentum, world.Momentum(), 1e-9);
            Assert.InRange(world.Energy(), 0, energy * (1 + 1e-9));
            energy = world.Energy();
            CheckNoOverlap(world);
        });
        var initialEnergy = 0.5 * world.Bodies.Sum(body => body.Description.Mass * body.Description.Velocity.LengthSquared());
        Assert.True(energy < 0.99 * initialEnergy, "nothing met");
    });

    [Fact]
    public void Cloud_OfElasticSpheres_KeepsItsEnergy() => Seeded.Run(3, random =>
    {
        var world = TestWorlds.Create(Vector.Zero, 1 / 120.0, TestWorlds.Place(PhysicsMeshes.Scale(PhysicsMeshes.InwardCube, 6)));
        for (var i = 0; i < 27; i++)
        {
            var position = 1.5 * (new Vector(i % 3, i / 3 % 3, i / 9) - Vector.One);
            world.Add(new(position, random.Between(0.2, 0.6))
            {
                Mass = random.Between(0.1, 10), Velocity = random.Vector(3), Restitution = 1,
            });
        }

        var energy = world.Energy();
        world.Run(600, () =>
        {
            Near.Equal(energy, world.Energy(), 1e-9 * energy);
            CheckNoOverlap(world);
        });
    });

    /// <summary>Balls and compounds of very different sizes and masses that go many radii in a step.</summary>
    [Fact]
    public void Crowd_OfAnySpeedAndMass_StaysApartAndGainsNoEnergy() =>
        Seeded.Run(6, random => CheckCrowd(random, 60, 40, hasCompounds: random.Next(2) == 0));

    [Fact]
    [Trait("Category", "Soak")]
    public void Crowds_OfAnySpeedAndMass_StayApartAndGainNoEnergy() =>
        Parallel.For(1, 200, seed => Seeded.RunOne(seed, random => CheckCrowd(random, 300, 60, hasCompounds: random.Next(2) == 0)));

    private static void CheckCrowd(Random random, int maxCount, int steps, bool hasCompounds)
    {
        const double Half = 2;
        var settings = new PhysicsSettings { SleepSpeed = random.Next(2) == 0 ? 0 : null, MaxThreads = random.Next(1, 4) };
        var gravity = random.Vector(Math.Pow(10, random.Between(0, 2)));
        var world = TestWorlds.Create(gravity, settings, TestWorlds.Place(PhysicsMeshes.Scale(PhysicsMeshes.InwardCube, 2 * Half)));
        var (size, speed) = (Math.Pow(10, random.Between(-1.5, -0.5)), Math.Pow(10, random.Between(-1, 2.5)));
        for (var i = 0; i < maxCount; i++)
        {
            var radius = size * Math.Pow(10, random.Between(-1, 0));
            var position = random.Vector(Half - radius);
            if (world.Bodies.All(other => (other.Position - position).Length() > other.Radius + radius))
            {
                // Of three balls, within the same radius.
                var shape = CompoundShape.OfBalls(
                    Enumerable.Range(0, 3).Select(_ => new CompoundBall(random.Vector(0.4 * radius), 0.3 * radius)));
                var description = random.Next(4) == 0 && hasCompounds
                    ? new BodyDescription(position, shape) : new BodyDescription(position, radius);
                world.Add(description with
                {
                    Velocity = random.Vector(speed),
                    Mass = Math.Pow(10, random.Between(-1.5, 1.5)),
                    Friction = random.Next(2) * 0.5,
                    Restitution = random.Next(2) * random.NextDouble(),
                    AngularVelocity = random.Vector(10),
                });
            }
        }

        // From where potential energy is positive all over the box.
        double Energy() => world.Energy() + (2 * Half * gravity.Length() * world.Bodies.Sum(body => body.Description.Mass));
        var energy = Energy();
        world.Run(steps, () =>
        {
            var after = Energy();
            Assert.True(after <= energy * (1 + 1e-3), $"from {energy:R} to {after:R} in step {world.StepCount}");
            energy = after;
            foreach (var body in world.Bodies)
            {
                for (var ball = 0; ball < body.BallCount; ball++)
                {
                    var end = body.BallCentre(ball).MaxAbsComponent() + body.BallRadius(ball);
                    Assert.True(
                        end <= Half + (MaxOverlap * body.BallRadius(ball)), $"{body.Name} ends at {end:R} in step {world.StepCount}");
                }
            }

            CheckNoOverlap(world);
        });
    }

    private static void CheckPoured(int count, int steps, int seed)
    {
        const double Half = 3;
        var random = new Random(seed);
        var box = PhysicsMeshes.FlipWinding(PhysicsMeshes.Cube.Transform(v => (2 * Half * v).Stretch(new(1, 4, 1))));
        var world = TestWorlds.Create(TestWorlds.Gravity, 1 / 60.0, TestWorlds.Place(box));
        // One is 50 times as large as the smallest.
        world.Add(new(new(0.2, -8, 0.1), 2) { Mass = 50, Friction = 0.5, IsRotationLocked = true });
        world.AddRange(Enumerable.Range(0, count - 1).Select(i =>
        {
            var position = new Vector(-2.5 + (i % 6), -5 + (1.1 * (i / 36)), -2.5 + (i / 6 % 6)) + random.Vector(0.04);
            return new BodyDescription(position, i == 0 ? 0.04 : 0.04 * Math.Pow(11, random.NextDouble()))
            {
                Mass = random.Between(0.1, 5), Friction = 0.5, Restitution = random.Between(0, 0.5), IsRotationLocked = true,
            };
        }));
        world.Run(steps, () =>
        {
            foreach (var body in world.Bodies)
            {
                var clearance = new Vector(Half, 4 * Half, Half) - body.Position.Absolute();
                var gap = Math.Min(clearance.X, Math.Min(clearance.Y, clearance.Z));
                Assert.True(gap >= body.Radius * (1 - MaxOverlap),
                    $"{body.Name} of radius {body.Radius:R} is {gap:R} from a wall after {world.StepCount} steps");
                Assert.False(body.IsStuck, $"{body.Name} is stuck after {world.StepCount} steps");
            }

            CheckNoOverlap(world);
        });
        var awake = world.Bodies.Where(body => !body.IsAsleep).ToArray();
        var example = awake.FirstOrDefault();
        var state = $"of radius {example?.Radius:R} at {example?.Position}, {example?.Velocity}";
        Assert.True(awake.Length == 0, $"{awake.Length} of {count} are awake, such as {example?.Name} {state}");
    }

    private static void CheckNoOverlap(PhysicsWorld world)
    {
        foreach (var body in world.Bodies)
        {
            foreach (var other in world.Bodies.Take(body.Index))
            {
                if (BallPairs.AreOverlapping(body, other, MaxOverlapOfBalls))
                {
                    Assert.Fail(FormattableString.Invariant(
                        $"{body.Name} and {other.Name} overlap after {world.StepCount} steps: radii {body.Radius} and {other.Radius}"));
                }
            }
        }
    }
}
