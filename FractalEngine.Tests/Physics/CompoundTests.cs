using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics;
using FractalEngine.Core.Physics.Bodies;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Physics;

/// <summary>Rigid bodies of several balls, against the mechanics of rigid bodies.</summary>
public class CompoundTests
{
    [Fact]
    public void AngularMomentum_OfATumblingBody_IsConstantAndSoIsItsEnergy() => Seeded.Run(5, random =>
    {
        var world = TestWorlds.Create(Vector.Zero, 1 / 60.0);
        var body = world.Add(new(random.Vector(), CreateCrooked()) { Mass = 2, AngularVelocity = random.Vector(10) });
        var momentum = AngularMomentum(body);
        var energy = SpinEnergy(body);
        // 10 s of some 10 rad/s, in turns of a 100th by a method of the fourth order.
        world.Run(600, () =>
        {
            Near.Equal(momentum, AngularMomentum(body), 1e-6 * momentum.Length());
            Near.Equal(energy, SpinEnergy(body), 1e-6 * energy);
        });
    });

    [Fact]
    public void Spin_AboutTheMiddleAxis_TurnsOver()
    {
        var world = TestWorlds.Create(Vector.Zero, 1 / 60.0);
        // Dzhanibekov's effect: of three different moments, that about the middle axis is unstable.
        Vector[] places = [new(-2, 0, 0), new(2, 0, 0), new(0, 1, 0), new(0, -1, 0)];
        var shape = CompoundShape.OfBalls(places.Select(static place => new CompoundBall(place, 0.5)));
        var body = world.Add(new(Vector.Zero, shape) { AngularVelocity = new(0.01, 10, 0) });
        var least = 1.0;
        world.Run(600, () => least = Math.Min(least, body.Orientation.Rotate(Vector.J).Y));
        Assert.InRange(least, -1, -0.99);
    }

    [Theory]
    [InlineData(0.3, 0.6)]
    [InlineData(0.8, 0.6)]
    [InlineData(1.2, 0.9)]
    public void Dumbbell_ThatFallsOnOneEnd_LeavesAsTheImpulseSays(double tilt, double restitution)
    {
        const double Height = 3;
        var arm = new Vector(Math.Cos(tilt), Math.Sin(tilt), 0);
        var shape = CompoundShape.OfBalls([new(-1 * arm, 0.5), new(arm, 0.5)]);
        var world = CreateOnFloor();
        var body = world.Add(new(new(0, Height, 0), shape) { Restitution = restitution });
        var speed = Math.Sqrt(2 * 9.8 * (Height - arm.Y - 0.5));
        var time = speed / 9.8;
        // An impulse J along y at the arm −a gives J/m and −a·x J/I: the point gets (1/m + x²/I)·J = (1 + e)·speed.
        var inertia = shape.Inertia.V3.Z;
        var impulse = (1 + restitution) * speed / (1 + (arm.X * arm.X / inertia));
        world.Run((int)Math.Ceiling(60 * time));
        Near.Equal(-arm.X * impulse / inertia, body.AngularVelocity.Z, 1e-7);
        Near.Equal(impulse - speed - (9.8 * (world.Time - time)), body.Velocity.Y, 1e-7);
    }

    [Theory]
    [InlineData(0)]
    [InlineData(2)]
    public void Capsule_OnASlope_RollsAsItsInertiaSays(double length)
    {
        const double Radius = 0.4;
        var sine = Math.Sin(20 * Math.PI / 180);
        var normal = new Vector(sine, Math.Cos(20 * Math.PI / 180), 0);
        var world = TestWorlds.Create(
            TestWorlds.Gravity, 1 / 60.0, TestWorlds.Place(PhysicsMeshes.FromTriangles(PhysicsMeshes.PlaneTriangle(Vector.Zero, normal))));
        var shape = CompoundShape.Capsule(new(0, 0, -0.5 * length), new(0, 0, 0.5 * length), Radius);
        var body = world.Add(new(Radius * normal, shape) { Friction = 0.5 });
        world.Run(60);
        var speed = 9.8 * sine / (1 + (shape.Inertia.V3.Z / (Radius * Radius)));
        Near.Equal(speed, body.Velocity.Length(), 1e-6);
        Near.Equal(speed / Radius, Math.Abs(body.AngularVelocity.Z), 1e-6);
    }

    [Fact]
    public void Capsule_Dropped_ComesToRestOnItsSide()
    {
        var world = CreateOnFloor();
        var shape = CompoundShape.Capsule(new(-1, 0, 0), new(1, 0, 0), 0.4);
        var body = world.Add(new(new(0, 2, 0), shape)
        {
            Restitution = 0.3, Friction = 0.5, RollingFriction = 0.05, AngularVelocity = new(0.3, 1, 2),
        });
        var energy = Energy(body);
        world.Run(600, () =>
        {
            var after = Energy(body);
            Assert.True(after <= energy + 1e-9, $"from {energy:R} to {after:R} in step {world.StepCount}");
            energy = after;
        });
        Assert.True(body.IsAsleep);
        Near.Equal(0.4, body.Position.Y, 1e-6);
        Assert.InRange(Enumerable.Range(0, body.BallCount).Min(ball => body.BallCentre(ball).Y), 0.4 * (1 - 1e-6), 0.4 * (1 + 1e-6));
    }

    [Fact]
    public void Table_OfFourLegs_StandsExactly()
    {
        var world = CreateOnFloor();
        var legs = new Vector[] { new(-1, 0, -1), new(1, 0, -1), new(-1, 0, 1), new(1, 0, 1) };
        var shape = CompoundShape.OfBalls([.. legs.Select(leg => new CompoundBall(leg, 0.3)), new(new(0, 1, 0), 0.6)]);
        var position = shape.Centre + (0.3 * Vector.J);
        var body = world.Add(new(position, shape) { Friction = 0.5 });
        world.Run(120);
        Near.Equal(position, body.Position, 1e-8);
        Assert.True(body.IsAsleep);
    }

    [Fact]
    public void Capsules_OnEachOther_Stand()
    {
        var world = CreateOnFloor();
        for (var i = 0; i < 5; i++)
        {
            // Crosswise, as logs are piled.
            var half = i % 2 == 0 ? Vector.I : Vector.K;
            var shape = CompoundShape.Capsule(-1 * half, half, 0.25);
            var across = i % 2 == 0 ? Vector.K : Vector.I;
            world.Add(new(((0.25 + (0.5 * i)) * Vector.J) - (0.75 * across), shape) { Friction = 0.5, RollingFriction = 0.01 });
            world.Add(new(((0.25 + (0.5 * i)) * Vector.J) + (0.75 * across), shape) { Friction = 0.5, RollingFriction = 0.01 });
        }

        var positions = world.Bodies.Select(body => body.Position).ToArray();
        world.Run(300);
        Assert.All(world.Bodies, body => Near.Equal(positions[body.Index], body.Position, 1e-3));
        Assert.False(world.IsMoving);
    }

    [Fact]
    public void Shots_ThatSpin_PassNoThinPlate() => CheckShots(60);

    [Fact]
    [Trait("Category", "Soak")]
    public void ManyShots_ThatSpin_PassNoThinPlate() => CheckShots(3000);

    [Fact]
    public void Heap_InABox_NeitherOverlapsNorLeavesNorGainsEnergy_AndComesToRest()
    {
        var world = CheckHeap(16, 1);
        Assert.False(world.IsMoving, $"{world.Bodies.Count(body => !body.IsAsleep)} are awake");
    }

    [Theory]
    [InlineData(2)]
    [InlineData(3)]
    [Trait("Category", "Soak")]
    public void LargeHeap_InABox_NeitherOverlapsNorLeavesNorGainsEnergy(int seed) => _ = CheckHeap(80, seed);

    [Fact]
    public void Capsules_OnASponge_AreNeverNearerThanTheirRadius()
    {
        const double Radius = 0.02;
        var world = TestWorlds.Create(TestWorlds.Gravity, 1 / 60.0);
        world.AddStatic(PhysicsMeshes.CreateSponge(3));
        var cubes = CubesOfTheSponge(3);
        var random = new Random(4);
        var shape = CompoundShape.Capsule(-0.05 * Vector.I, 0.05 * Vector.I, Radius);
        for (var i = 0; i < 6; i++)
        {
            var position = new Vector(random.Between(-0.4, 0.4), 0.6 + (0.1 * i), random.Between(-0.4, 0.4));
            world.Add(new(position, shape) { Friction = 0.4, Restitution = 0.3, AngularVelocity = random.Vector(20) });
        }

        var touching = 0;
        world.Run(90, () =>
        {
            // All cubes are compared with all balls, which takes longer than a step.
            foreach (var body in world.StepCount % 3 == 0 ? world.Bodies : [])
            {
                for (var ball = 0; ball < body.BallCount; ball++)
                {
                    var centre = body.BallCentre(ball);
                    var half = 0.5 / 27 * Vector.One;
                    var distance = cubes.Min(cube => Vector.Max((centre - cube).Absolute() - half, Vector.Zero).LengthSquared());
                    distance = Math.Sqrt(distance);
                    Assert.True(distance >= Radius * (1 - 1e-6), $"{body.Name} is {distance:R} away after {world.StepCount} steps");
                    touching += distance < Radius * (1 + 1e-6) ? 1 : 0;
                }
            }
        });
        Assert.NotEqual(0, touching);
    }

    [Fact]
    public void Run_Repeated_GivesTheSameBits()
    {
        string Run()
        {
            var world = CreateHeap(20, 5);
            world.Run(60);
            return world.StateHash;
        }

        Assert.Equal(Run(), Run());
    }

    /// <summary>Centres of all cubes of a sponge of side 1 about the origin.</summary>
    private static List<Vector> CubesOfTheSponge(int depth)
    {
        List<Vector> cubes = [Vector.Zero];
        for (var level = 1; level <= depth; level++)
        {
            var size = Math.Pow(3, -level);
            cubes =
            [
                .. from cube in cubes
                   from x in new[] { -1, 0, 1 }
                   from y in new[] { -1, 0, 1 }
                   from z in new[] { -1, 0, 1 }
                   where (x * x) + (y * y) + (z * z) > 1
                   select cube + (size * new Vector(x, y, z)),
            ];
        }

        return cubes;
    }

    private static void CheckShots(int count) => Seeded.Run(1, random =>
    {
        var dumbbell = CompoundShape.OfBalls([new(-1 * Vector.I, 0.5), new(Vector.I, 0.5)]);
        var capsule = CompoundShape.Capsule(-1 * Vector.I, Vector.I, 0.2);
        for (var shot = 0; shot < count; shot++)
        {
            var plate = PhysicsMeshes.Cube.Transform(v => v.Stretch(new(200, 0.001, 200)));
            var world = TestWorlds.Create(TestWorlds.Gravity, 1 / 60.0, TestWorlds.Place(plate));
            var speed = Math.Pow(10, random.Between(1, 4));
            var position = new Vector(random.Between(-1, 1), random.Between(2.5, 4.5), random.Between(-1, 1));
            var body = world.Add(new(position, shot % 2 == 0 ? dumbbell : capsule)
            {
                Velocity = new(random.Between(-0.1, 0.1) * speed, -speed, random.Between(-0.1, 0.1) * speed),
                AngularVelocity = random.Between(0, speed) * random.Vector(1),
                Restitution = random.NextDouble(),
                Friction = random.NextDouble(),
            });
            world.Run(4, () =>
            {
                for (var ball = 0; ball < body.BallCount; ball++)
                {
                    Assert.True(
                        body.BallCentre(ball).Y >= body.BallRadius(ball) * (1 - 1e-6) || body.Position.Absolute().MaxAbsComponent() > 90,
                        $"shot {shot} at {speed:R}: ball {ball} at {body.BallCentre(ball)} after {world.StepCount} steps");
                }
            });
        }
    });

    private static PhysicsWorld CheckHeap(int count, int seed)
    {
        var world = CreateHeap(count, seed);
        var energy = world.Bodies.Sum(Energy);
        for (var step = 0; step < 1200 && world.IsMoving; step++)
        {
            world.Step();
            var after = world.Bodies.Sum(Energy);
            Assert.True(after <= energy * (1 + 1e-3), $"from {energy:R} to {after:R} in step {world.StepCount}");
            energy = after;
            CheckApart(world);
        }

        return world;
    }

    private static void CheckApart(PhysicsWorld world)
    {
        foreach (var body in world.Bodies)
        {
            for (var i = 0; i < body.BallCount; i++)
            {
                var centre = body.BallCentre(i);
                var clearance = Math.Min(centre.Y, 2 - Math.Max(Math.Abs(centre.X), Math.Abs(centre.Z)));
                var message = $"{body.Name} is {clearance:R} from a wall after {world.StepCount} steps";
                Assert.True(clearance >= body.BallRadius(i) * (1 - 1e-6), message);
                foreach (var other in world.Bodies.Take(body.Index))
                {
                    for (var j = 0; j < other.BallCount; j++)
                    {
                        var gap = (centre - other.BallCentre(j)).Length() - body.BallRadius(i) - other.BallRadius(j);
                        Assert.True(
                            gap >= -0.05 * Math.Min(body.BallRadius(i), other.BallRadius(j)),
                            $"{body.Name} and {other.Name} overlap by {-gap:R} after {world.StepCount} steps");
                    }
                }
            }
        }
    }

    /// <summary>Makes a box of 4 × 4, and above it capsules, balls and dumbbells.</summary>
    private static PhysicsWorld CreateHeap(int count, int seed)
    {
        var random = new Random(seed);
        var box = PhysicsMeshes.FlipWinding(PhysicsMeshes.Cube.Transform(v => (4 * v).Stretch(new(1, 50, 1)) + (100 * Vector.J)));
        var world = TestWorlds.Create(TestWorlds.Gravity, 1 / 60.0, TestWorlds.Place(box));
        var capsule = CompoundShape.Capsule(-0.5 * Vector.I, 0.5 * Vector.I, 0.25);
        var dumbbell = CompoundShape.OfBalls([new(-0.5 * Vector.I, 0.3), new(0.4 * Vector.I, 0.2)]);
        for (var i = 0; i < count; i++)
        {
            var place = new Vector(-0.9 + (i % 2 * 1.8), 1 + (i / 6 * 0.7), -1.2 + (i / 2 % 3 * 1.2)) + random.Vector(0.05);
            world.Add((i % 3) switch
            {
                0 => new(place, capsule) { Friction = 0.5, Restitution = 0.2 },
                1 => new(place, dumbbell) { Friction = 0.5, Restitution = 0.2, Mass = 2 },
                _ => new(place, 0.3) { Friction = 0.5, Restitution = 0.2, RollingFriction = 0.01 },
            });
        }

        return world;
    }

    private static PhysicsWorld CreateOnFloor() =>
        TestWorlds.Create(TestWorlds.Gravity, 1 / 60.0, TestWorlds.Place(PhysicsMeshes.FloorMesh()));

    private static CompoundShape CreateCrooked() =>
        CompoundShape.OfBalls([new(-1 * Vector.I, 0.5), new(1.2 * Vector.I, 0.4), new(0.7 * Vector.J, 0.3)]);

    private static Matrix InertiaOf(Body body)
    {
        var rotation = body.Orientation.ToMatrix();
        var own = body.Description.Shape?.Inertia ?? (body.Description.InertiaFactor * body.Radius * body.Radius * Matrix.Identity);
        return body.Description.Mass * (rotation * own * rotation.Transpose());
    }

    private static Vector AngularMomentum(Body body) => InertiaOf(body) * body.AngularVelocity;

    private static double SpinEnergy(Body body) => 0.5 * Vector.Dot(body.AngularVelocity, AngularMomentum(body));

    private static double Energy(Body body) =>
        (body.Description.Mass * ((0.5 * body.Velocity.LengthSquared()) + (9.8 * body.Position.Y))) + SpinEnergy(body);
}
