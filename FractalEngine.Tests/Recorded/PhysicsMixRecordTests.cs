using FractalEngine.Core.Colliders;
using FractalEngine.Core.Generation;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Core.Scenes;
using FractalEngine.Tests.Physics;
using FractalEngine.Tests.Support;
using static FractalEngine.Tests.Recorded.RecordedWorlds;

namespace FractalEngine.Tests.Recorded;

/// <summary>Crowded worlds for a few steps, in which much happens at once: swarms, overlaps, parallel work, and something of all.</summary>
public class PhysicsMixRecordTests
{
    // 1e-4 is a power of two of it.
    private const double CornerRadius = 10_000 / 16384.0;

    private static readonly int[] Few = [1, 2, 4, 8];

    private static readonly CompoundShape OneBall = CompoundShape.OfBalls([new(Vector.Zero, CornerRadius)]);

    [Fact]
    public void Worlds_OfBallsAndObjects() => RecordedText.Check("physics-mix-balls.txt",
    [
        .. MixedWorld.Record(1, WorldParts.Balls),
        .. MixedWorld.Record(2, WorldParts.Sleepers | WorldParts.Triggers),
        .. MixedWorld.Record(3, WorldParts.Movers),
        .. MixedWorld.Record(4, WorldParts.Layers | WorldParts.Triggers),
        .. MixedWorld.Record(5, WorldParts.Shrinking | WorldParts.Movers | WorldParts.Sleepers),
        .. MixedWorld.Record(6, WorldParts.Fractal | WorldParts.Kinds),
        .. MixedWorld.Record(7, WorldParts.Movers | WorldParts.Layers | WorldParts.Triggers | WorldParts.Kinds),
    ]);

    [Fact]
    public void Worlds_OfCompounds() => RecordedText.Check("physics-mix-compounds.txt",
    [
        .. MixedWorld.Record(11, WorldParts.Compounds),
        .. MixedWorld.Record(12, WorldParts.Compounds | WorldParts.Movers),
        .. MixedWorld.Record(13, WorldParts.Compounds | WorldParts.Layers | WorldParts.Sleepers | WorldParts.Triggers),
        .. MixedWorld.Record(14, WorldParts.Compounds | WorldParts.Fractal | WorldParts.Shrinking),
        .. MixedWorld.Record(15, WorldParts.Compounds | WorldParts.Kinds | WorldParts.Movers | WorldParts.Sleepers),
    ]);

    [Fact]
    public void Worlds_OfCharacters() => RecordedText.Check("physics-mix-characters.txt",
    [
        .. MixedWorld.Record(20, WorldParts.Character),
        .. MixedWorld.Record(21, WorldParts.Character | WorldParts.Movers),
        .. MixedWorld.Record(22, WorldParts.Character | WorldParts.Compounds | WorldParts.Sleepers),
        .. MixedWorld.Record(23, WorldParts.Character | WorldParts.Layers | WorldParts.Movers | WorldParts.Triggers),
        .. MixedWorld.Record(24, WorldParts.Character | WorldParts.Fractal | WorldParts.Kinds | WorldParts.Shrinking),
    ]);

    /// <summary>Clusters of balls that fly into each other, so fast that plans do not foresee all that they meet.</summary>
    [Fact]
    public void Swarms_ThatMeet() => RecordedText.Check("physics-mix-swarms.txt",
    [
        .. Enumerable.Range(0, 12).SelectMany(static seed => Record($"swarm {seed}", CreateSwarm(seed, threads: 1 + (seed % 3)), Few)),
        .. Enumerable.Range(0, 6).SelectMany(static seed => Record($"tumble {seed}", CreateTumble(seed), [1, 3, 6, 10])),
        .. Enumerable.Range(0, 4).SelectMany(static seed => RecordJam(seed)),
        .. Enumerable.Range(0, 3).SelectMany(static seed => Record($"press {seed}", CreatePress(seed), [1, 4, 8, 14])),
    ]);

    [Fact]
    public void Bodies_ThatOverlapFromTheBeginning() => RecordedText.Check("physics-mix-overlaps.txt",
    [
        .. Enumerable.Range(0, 8).SelectMany(static seed => Record($"overlap {seed}", CreateOverlapping(seed), [1, 2, 6])),
        // As near a corner as it may be to count as met: 1e-4 of the radius, to the last bit.
        .. Record("corner", Over([Shapes.Octahedron().Transform(static vertex => vertex - Vector.J)],
            Compound(new(0, CornerRadius + (1 / 16384.0), 0), OneBall, 2)), [1, 2, 3]),
    ]);

    [Theory]
    [InlineData("crush", 0)]
    [InlineData("lift", 1)]
    [InlineData("mixed", 2)]
    [InlineData("bounce", 3)]
    [InlineData("stacks", 4)]
    [InlineData("carpet", 5)]
    public void Crowds_OnOneAndMoreThreads_AreTheSame(string name, int kind)
    {
        string[] expected = [.. Record(name, CreateCrowd(kind, 1), [1, 2])];
        Assert.Equal(expected, Record(name, CreateCrowd(kind, 3), [1, 2]));
        RecordedText.Check($"physics-crowd-{name}.txt", expected);
    }

    /// <summary>Rows of balls and bars fall asleep, are hit one after the other, and wake those that touch them.</summary>
    [Fact]
    public void Rows_ThatSleepAndWake()
    {
        var world = new PhysicsWorld(new PhysicsSettings { SleepSpeed = 0.3, TimeBeforeSleep = 0.1, ReportsContacts = true }).Fill(
            [Shapes.Box(new(new(-9, -1, -9), new(9, 0, 9))), Shapes.Box(new(new(5, 0, -9), new(5.5, 0.4, 9)))],
            [
                .. Enumerable.Range(0, 24).Select(static i => Ball(new((i % 6) - 3, 0.5, 2 * (i / 6)), 0.5, i) with
                {
                    Restitution = 0, RollingFriction = 0.1, Friction = 0.5,
                }),
                .. Enumerable.Range(0, 4).Select(static i =>
                    Compound(new(-3 + (1.3 * i), 0.25, -2), Bar, i) with { RollingFriction = 0.1 }),
                Ball(new(-3, 1.5, 0), 0.5, 3), Ball(new(0, 0.4, -5), 0.4, 1) with { Velocity = new(0.2, 0, 0), Shrinkage = 0.3 },
            ]);
        var character = world.AddCharacter(new(new(3.2, 0.5, 4), 0.3, 1));
        RecordedText.Check("physics-mix-sleepers.txt", Record("rows", world, [4, 8, 12, 20, 26, 30, 34, 38, 44, 60], step =>
        {
            switch (step)
            {
                case 14: world.ApplyForce(world.Bodies[2], new(0, 0, 30)); break;
                case 16: world.ApplyImpulse(world.Bodies[24], new(0, 0, 1)); break;
                case 20: world.Add(Ball(new(-3, 3, 2), 0.3, 2) with { Velocity = new(0, -9, 0) }); break;
                case 24: world.StaticObjects[1].SetMotion(new(-6, 0, 0)); break;
                case 30: world.StaticObjects[1].SetMotion(Vector.Zero, new(0, 1, 0)); break;
                case 32: character.IsActive = true; break;
                case 33: character.MoveInput = -Vector.I; break;
                case 42: character.IsActive = false; break;
                case 46: world.Gravity = new(0, -12, 0); break;
                case 50: world.SetVelocity(world.Bodies[20], new(0, 2, 0)); break;
            }
        }));
    }

    [Fact]
    public void Characters_OfManySizes() => RecordedText.Check("physics-mix-walks.txt",
    [
        // So fast that a step is longer than the radius: over a ledge, a gap and up stairs.
        .. Walk("ledge", new(new(0, 0.6, 0), 0.2, 1.2) { WalkingSpeedOverride = 30 }, [Shapes.Box(new(new(2, 0, -3), new(2.2, 0.2, 3)))]),
        .. Walk("thin ledge", new(new(0.6, 0.6, 0), 0.2, 1.2) { WalkingSpeedOverride = 60 },
            [Shapes.Box(new(new(2, 0, -3), new(2.1, 0.2, 3)))]),
        .. Walk("long ledge", new(new(0, 0.6, 0), 0.2, 1.2) { WalkingSpeedOverride = 30 },
            [Shapes.Box(new(new(2, 0, -3), new(2.4, 0.2, 3))), Shapes.Box(new(new(2.9, 0, -3), new(6, 0.2, 3)))]),
        .. Walk("stairs", new(new(0, 0.6, 0), 0.2, 1.2) { WalkingSpeedOverride = 20 }, Steps()),
        .. Walk("high steps", new(new(0, 0.6, 0), 0.3, 1.2) { StepHeightOverride = 0.6, JumpSpeedOverride = 5 }, Steps(), 12),
        .. Walk("no steps", new(new(0, 0.6, 0), 0.3, 1.2) { StepHeightOverride = 0 }, Steps()),
        .. Walk("round", new(new(0, 0.3, 0), 0.3, 0.6), Steps(), 20),
        .. Walk("steep", new(new(-2, 0.9, 0), 0.3, 1.8) { MaxSlopeAngle = 89 }, [Slope(70)]),
        .. Walk("level", new(new(-2, 0.9, 0), 0.3, 1.8) { MaxSlopeAngle = 0 }, [Slope(5)], 30),
        .. Walk("sphere", new(new(-2, 0.9, 0), 0.3, 1.8), [Shapes.Sphere(2)], 25),
        .. Walk("groove", new(new(0, 1.5, 0), 0.3, 1.4), [Groove(3)], 10),
        .. Walk("corner", new(new(0, 1.2, 0.1), 0.3, 1.4), InwardBox(3)),
        .. Walk("under", new(new(0, 0.6, 0), 0.2, 1.2), [Shapes.Box(new(new(1, 1.3, -3), new(2, 1.4, 3))), .. Steps()], 9),
    ]);

    /// <summary>Capsules and balls that are fitted to models under any matrix.</summary>
    [Fact]
    public void Fits_OfShapesToModels()
    {
        var random = new Random(9);
        Model[] models =
        [
            Model.Of(PhysicsMeshes.Cube), Model.Of(Samples.Tetrahedron), Model.Of(Shapes.Sphere(1)), Model.Of(Shapes.Octahedron()),
            new FractalModel(PhysicsMeshes.CreateSponge(1)), Model.Of(Slot(2)),
            Model.Of(Shapes.Box(new(new(0.5, 0, 0), new(4, 0.3, 0.2)))), Model.Of(Shapes.Box(new(new(0, -3, 1), new(0.2, 0.3, 1.4)))),
        ];
        BodyShape[] shapes =
            [BodyShape.Ball, BodyShape.Capsule, BodyShape.Balls(1), BodyShape.Balls(2), BodyShape.Balls(5), BodyShape.Balls(9)];
        RecordedText.Check("physics-mix-fits.txt", from model in models
                                                   from shape in shapes
                                                   let placement = random.Transformation()
                                                   let declared = new PhysicsObject(model) { Placement = placement, Shape = shape }
                                                   select Describe(new(declared), declared));
    }

    private static string Describe(PlacedModel placed, PhysicsObject declared)
    {
        var description = BodyDescription.FromPhysicsObject(placed, declared, 0);
        var (position, offset) = (description.Position, description.ObjectOffset);
        var shape = description.Shape;
        var balls = shape?.Balls.Select((ball, i) => (1 + (0.1 * i)) * (ball.Radius + Vector.Dot(ball.Offset, new(1, 2, 3)))).Sum();
        return $"{description.Shape?.Balls.Length} {shape?.IsCapsule} {RecordedText.Text(description.Radius)} "
            + $"{RecordedText.Text(1 + Vector.Dot(position, new(1, 2, 3)))} {RecordedText.Text(1 + Vector.Dot(offset, new(1, 2, 3)))} "
            + $"{RecordedText.Text(1 + (balls ?? 0))} "
            + RecordedText.Text(1 + (shape is null ? 0 : Vector.Dot(new(1, 2, 3), shape.Inertia * new Vector(3, 1, 2))));
    }

    private static IEnumerable<string> Walk(string name, Player player, Mesh[] meshes, int jumpPeriod = 1000)
    {
        var world = OnFloor(Ball(new(1.4, 0.2, 0.5), 0.2, 2)).Fill(meshes, []);
        var lift = world.AddStatic(PhysicsMeshes.Cube, new(new(-1, -0.4, 2), Vector.Zero, new(2, 1, 1)));
        lift.SetMotion(new(0, 0.4, -0.2), new(0, 0.3, 0));
        var character = world.AddCharacter(player);
        character.IsActive = true;
        return Record(name, world, [1, 6, 20, 50], step =>
        {
            character.MoveInput = step < 25 ? new(1, 0, 0.05) : new(-0.8, 0, 0.8);
            if (step % jumpPeriod == jumpPeriod - 1)
            {
                character.Jump();
            }

            if (step == 22)
            {
                character.Teleport(character.Position + new Vector(0, 0.1, 0));
            }

            world.Gravity = step == 40 ? new(1, -9, 0) : world.Gravity;
        });
    }

    private static PhysicsWorld CreateSwarm(int seed, int threads)
    {
        var random = new Random(seed);
        var world = new PhysicsWorld(new PhysicsSettings { MaxThreads = threads, ReportsContacts = seed % 2 == 0 })
        {
            Gravity = seed % 4 == 3 ? TestWorlds.Gravity : Vector.Zero,
        };
        if (seed % 4 > 1)
        {
            world.AddStatic(PhysicsMeshes.FloorMesh(), Transformation.At(new Vector(0, -1.2, 0)));
        }

        var bodies = new List<BodyDescription>();
        for (var cluster = 0; cluster < 4; cluster++)
        {
            var centre = (seed > 3 ? 0.7 : 1.5) * (cluster % 2 == 0 ? 0.8 : 1.3) * random.Direction();
            var velocity = -(seed > 3 ? random.Between(1, 15) : random.Between(8, 60)) * centre;
            for (var i = 0; i < 9; i++)
            {
                var place = centre + (0.3 * new Vector((i % 3) - 1, (i / 3) - 1, random.Between(-0.3, 0.3)));
                bodies.Add(Ball(place, random.Between(0.12, 0.15), i) with
                {
                    Velocity = velocity + random.Vector(0.5),
                    Restitution = seed % 3 == 0 ? 0 : 0.2 * (i % 5),
                    Mass = i == 4 ? 40 : 1,
                    RollingFriction = seed % 2 * 0.02,
                });
            }
        }

        bodies.AddRange(Enumerable.Range(0, 8).Select(i => Ball(random.Vector(1.5), 0.08, i) with { Velocity = random.Vector(20) }));
        if (seed is 7 or 11)
        {
            bodies.AddRange(Enumerable.Range(0, 4).Select(i => Compound(random.Vector(1.5), Dumbbell, i) with
            {
                Velocity = random.Vector(20),
                AngularVelocity = random.Vector(20),
            }));
        }

        // Some are as small as dust, and some as large as hills.
        var scale = seed switch { 8 => 1e-3, 9 => 300, 10 => 0.02, _ => 1 };
        var scaled = bodies.Select(body => body.Shape is null
            ? body with { Position = scale * body.Position, Radius = scale * body.Radius, Velocity = scale * body.Velocity } : body);
        // The first body takes part as any other one does.
        world.AddRange(seed % 2 == 0 ? scaled : scaled.Reverse());
        return world;
    }

    /// <summary>A block of balls that touch falls onto edges and corners, which turn some of them aside.</summary>
    private static PhysicsWorld CreateTumble(int seed)
    {
        var random = new Random(200 + seed);
        var world = new PhysicsWorld(new PhysicsSettings { MaxThreads = 1 + (seed % 3) });
        world.AddStatic(PhysicsMeshes.CreateSponge(2), new(new(0, -0.6, 0), random.Degrees(), Vector.One));
        world.AddStatic(PhysicsMeshes.Cube, new(new(0.7, -0.4, 0.1), random.Degrees(), 0.6 * Vector.One));
        world.AddStatic(Shapes.Sphere(1), Transformation.At(new Vector(-0.7, -0.5, 0.2), 0.5));
        world.AddStatic(PhysicsMeshes.FloorMesh(), Transformation.At(new Vector(0, -1.2, 0)));
        world.AddRange(from i in Enumerable.Range(0, 4)
                       from j in Enumerable.Range(0, 3)
                       from k in Enumerable.Range(0, 4)
                       let place = 0.2 * new Vector(i - 1.5, j + 2.2, k - 1.5)
                       select Ball(place + random.Vector(0.0001), 0.0999, i + j + k) with
                       {
                           Velocity = new(random.Between(-1, 1), -3 - (3 * seed), 0),
                           Restitution = seed % 2 == 0 ? 0 : 0.3,
                           Friction = 0.3 * (seed % 3),
                       });
        return world;
    }

    /// <summary>Balls and bars that forces pull to one place, where they hold each other up.</summary>
    private static IEnumerable<string> RecordJam(int seed)
    {
        var random = new Random(300 + seed);
        var world = new PhysicsWorld(new PhysicsSettings { SleepSpeed = 0 }) { Gravity = Vector.Zero };
        if (seed % 2 == 0)
        {
            world.AddStatic(Shapes.Octahedron(), Transformation.At(Vector.Zero, 0.3));
        }

        world.AddRange(Enumerable.Range(0, 22).Select(i =>
        {
            var place = (0.5 + (0.04 * i)) * random.Direction();
            return seed == 3 && i % 6 == 0
                ? Compound(2 * place, Bar, i) : Ball(place, random.Between(0.1, 0.2), i) with { Restitution = 0 };
        }));
        return Record($"jam {seed}", world, [1, 6, 12, 18], _ =>
        {
            foreach (var body in world.Bodies)
            {
                world.SetForce(body, -60 * body.Position);
            }
        });
    }

    /// <summary>Two plates press balls against each other and into corners, until some are stuck.</summary>
    private static PhysicsWorld CreatePress(int seed)
    {
        var random = new Random(400 + seed);
        var world = Over(InwardBox(1.2));
        world.AddStatic(Shapes.Box(new(new(-0.55, 0.6, -0.55), new(0.55, 0.9, 0.55)))).SetMotion(new(0, -3, 0));
        world.AddStatic(Shapes.Box(new(new(0.6, -0.55, -0.55), new(0.9, 0.3, 0.55)))).SetMotion(new(-2, 0, 0), new(0, 0, 0.3 * seed));
        world.AddRange(Enumerable.Range(0, 20).Select(i =>
            Ball(0.25 * new Vector((i % 3) - 1, (i / 9) - 1.1, (i / 3 % 3) - 1), random.Between(0.09, 0.12), i) with
            {
                Restitution = seed == 2 ? 0.4 : 0,
                RollingFriction = 0.01 * seed,
            }));
        return world;
    }

    private static PhysicsWorld CreateOverlapping(int seed)
    {
        var random = new Random(100 + seed);
        var world = new PhysicsWorld(new PhysicsSettings { MaxThreads = 1 + (seed % 2) }).Fill(
            [PhysicsMeshes.FloorMesh(), Shapes.Box(new(new(-0.6, -1, -0.6), new(0.6, 0.6, 0.6))), Slot(0.3).Transform(
                static vertex => vertex + new Vector(1.5, 0, 0))], []);
        if (seed % 3 == 0)
        {
            world.AddStatic(PhysicsMeshes.CreateSponge(2), Transformation.At(new Vector(-1.5, 0.5, 0)));
        }

        if (seed % 4 == 1)
        {
            world.AddStatic(Shapes.Box(new(new(-2, 0.1, -1), new(-1.2, 0.8, 1)))).SetMotion(new(2, 0, 0), new(0, 1, 0));
        }

        world.AddRange(Enumerable.Range(0, 16).Select(i =>
        {
            var place = new Vector(random.Between(-2, 2), random.Between(-0.1, 1), random.Between(-1, 1));
            return seed % 2 == 0 && i % 4 == 0 ? Compound(place, i % 8 == 0 ? Bar : Odd, i) : Ball(place, random.Between(0.1, 0.3), i);
        }));
        // Two at one place, and one where a face is.
        world.AddRange([Ball(new(3, 1, 0), 0.2, 1), Ball(new(3, 1, 0), 0.2, 2), Ball(new(0, 0.6, 0), 0.2, 3)]);
        return world;
    }

    private static PhysicsWorld CreateCrowd(int kind, int threads)
    {
        var random = new Random(kind);
        var world = new PhysicsWorld(new PhysicsSettings { MaxThreads = threads, ReportsContacts = kind == 2 });
        world.AddStatic(PhysicsMeshes.FloorMesh(1000));
        var (x, y, z) = kind switch
        {
            0 => (20, 6, 9),
            1 => (9, 5, 8),
            2 => (8, 5, 8),
            3 => (12, 8, 10),
            4 => (16, 3, 16),
            _ => (22, 2, 22),
        };
        var spacing = kind switch { 3 => 0.25, 4 => 0.5, 5 => 0.1962, _ => 0.199 };
        var bodies = from i in Enumerable.Range(0, x)
                     from j in Enumerable.Range(0, y)
                     from k in Enumerable.Range(0, z)
                     let height = (kind == 5 ? 0.098 : 0.12) + (j * (kind == 3 ? 0.25 : 0.2))
                     let place = spacing * new Vector(i - (0.5 * x), 0, k - (0.5 * z)) + (height * Vector.J)
                     select Ball(place + random.Vector(kind > 3 ? 0 : 0.003), 0.098, i + j + k) with
                     {
                         Restitution = kind == 3 ? 0.3 : 0,
                         RollingFriction = kind == 4 ? 0.02 : 0,
                         Velocity = kind == 0 ? new(random.Between(-3, 3), -6, 0) : kind == 3 ? random.Vector(4)
                             // Each meets the next one while it lies on the floor.
                             : kind == 5 ? -0.2 * (place with { Y = 0 }) : Vector.Zero,
                         Collider = kind == 2 && (i + k) % 3 == 1 ? ColliderKind.BoundingBox : ColliderKind.Exact,
                     };
        var all = bodies.ToList();
        if (kind == 2)
        {
            world.AddStatic(Shapes.Sphere(2), Transformation.At(new Vector(0, 0.2, 0), 0.5));
            // One of the kind that few have comes first.
            all.Insert(0, Ball(new(-2, 0.2, 0), 0.1, 1) with { Collider = ColliderKind.BoundingBox });
            all.Add(Compound(new(0.1, 1.5, 0.1), Bar, 2));
        }

        world.AddRange(all);
        if (kind == 1)
        {
            world.AddStatic(Shapes.Box(new(new(-2, -0.5, -2), new(2, 0.015, 2)))).SetMotion(new(0.4, 1.3, 0));
        }

        return world;
    }
}
