using FractalEngine.Core.Colliders;
using FractalEngine.Core.Generation;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Core.Queries;
using FractalEngine.Core.Rays;
using FractalEngine.Core.Scenes;
using FractalEngine.Tests.Colliders;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Physics;

/// <summary>
/// Steps and queries allocate nothing from the first one on: room is made when bodies are added. Each world is made anew for each run,
/// outside of what is counted. Threads share jobs that do the same on one thread, where all that they allocate counts.
/// </summary>
[Collection(TimedTests.Name)]
public class AllocationTests
{
    private static readonly Dictionary<string, (int Steps, Func<Action<int>> Prepare)> Runs = new()
    {
        ["a fractal"] = (200, static () => StepsOf(CreateWorld("menger", 3, 0.04))),
        ["an infinite fractal"] = (60, static () => StepsOf(CreateWorld("infinite-menger", null, 0.06))),
        ["steps of varying lengths"] = (100, static () => StepsOf(CreateWorld("menger", 3, 0.04), static (world, step) =>
            world.Step((1 + (step % 7)) / 240.0))),
        ["skew objects and sleepers"] = (300, CreateSkew),
        ["a character"] = (100, CreateCharacter),
        ["compounds on a sponge"] = (15, static () => StepsOf(CreateCompounds())),
        ["a heap that threads share"] = (40, static () => StepsOf(CreateHeap(maxThreads: 1))),
        ["movers"] = (40, static () => StepsOf(CreateMill())),
        ["events"] = (200, static () => StepsOf(CreateReporting())),
        ["forces and impulses"] = (100, static () => StepsOf(CreateWorld("menger", 2, 0.04), Push)),
    };

    public static TheoryData<string> Names => [.. Runs.Keys];

    [Theory]
    [MemberData(nameof(Names))]
    public void Steps_OfANewWorld_AllocateNothing(string name) =>
        Assert.Equal(0, Allocation.Measure(Runs[name].Steps, Runs[name].Prepare));

    [Fact]
    [Trait("Category", "Soak")]
    public void Steps_OfCompoundsThatComeToRest_AllocateNothing() =>
        Assert.Equal(0, Allocation.Measure(120, static () => StepsOf(CreateCompounds())));

    [Fact]
    public void Steps_OfAHeapOnManyThreads_AllocateNothingOnAny() =>
        Assert.Equal(0, Allocation.MeasureAllThreads(40, static () => StepsOf(CreateHeap(maxThreads: 4))));

    [Fact]
    public void Steps_WithMoreContactsThanThereIsRoomFor_AllocateOnce()
    {
        var world = CreateCrowd();
        Assert.True(Allocation.Measure(20, static () => StepsOf(CreateCrowd())) > 0, "there was room");
        world.Run(20);
        Assert.Equal(0, Allocation.Measure(20, () =>
        {
            world.Reset();
            return _ => world.Step();
        }));

        // So fast that each may meet dozens in a step: far more than there is room for.
        static PhysicsWorld CreateCrowd()
        {
            var random = new Random(1);
            var cube = new MeshModel(PhysicsMeshes.Cube);
            var bodies = Enumerable.Range(0, 150).Select(_ => new PhysicsObject(cube, 0)
            {
                Placement = Transformation.At(random.Vector(), 0.2), Velocity = 15 * random.Vector(),
            });
            return new(new Scene { Gravity = Vector.Zero, Objects = [.. bodies] });
        }
    }

    [Theory]
    [InlineData("menger", 5)]
    [InlineData("menger", 40)]
    [InlineData("tree", 10)]
    public void Queries_OfAContextThatHasBeenAsDeep_AllocateNothing(string name, int depth)
    {
        var fractal = AssetFractals.Load(name, depth);
        var (collider, caster) = (Collider.For(fractal), RayCaster.For(fractal));
        var random = new Random(1);
        var points = Enumerable.Range(0, 501).Select(_ => 2 * random.Vector()).ToArray();
        var context = new QueryContext();
        Assert.Equal(0, Allocation.Measure(500, () => i =>
        {
            collider.TryFindClosest(points[i], i % 2 == 0 ? 0.1 : double.PositiveInfinity, context, out _);
            caster.TryFindNearest(new(points[i], points[i + 1] - points[i]), context, out _);
        }));
    }

    [Fact]
    public void Casts_ThroughAWorld_AllocateNothing()
    {
        var world = CreateWorld("menger", 3, 0.04);
        var random = new Random(1);
        var points = Enumerable.Range(0, 501).Select(_ => 2 * random.Vector()).ToArray();
        Assert.Equal(0, Allocation.Measure(500, () => i =>
        {
            _ = world.TryCastSphere(points[i], 0.02, points[i + 1] - points[i], out _);
            _ = world.TryCastRay(new(points[i], points[i + 1] - points[i]), out _);
        }));
    }

    private static Action<int> StepsOf(PhysicsWorld world, Action<PhysicsWorld, int>? makeStep = null)
    {
        world.BuildColliders();
        foreach (var target in world.StaticObjects)
        {
            // An object takes some memory at the first query that reaches it.
            world.TryFindClosest(target.Bounds.Centre, ColliderKind.Exact, out _);
        }

        Assert.Contains(world.Bodies, static body => !body.IsAsleep);
        return step =>
        {
            if (makeStep is null)
            {
                world.Step();
            }
            else
            {
                makeStep(world, step);
            }
        };
    }

    private static void Push(PhysicsWorld world, int step)
    {
        var body = world.Bodies[step % world.Bodies.Count];
        world.ApplyForce(body, new(0.3, 20, 0.2), body.Position + (0.01 * Vector.I));
        world.ApplyImpulse(body, new(0.01, 0.3, 0.02), body.Position + (0.01 * Vector.K));
        world.SetVelocity(world.Bodies[step * 7 % world.Bodies.Count], new(0.1, 1, 0.2));
        world.Step();
    }

    private static PhysicsWorld CreateWorld(string fractal, int? depth, double radius)
    {
        var world = new PhysicsWorld(new PhysicsSettings { SleepSpeed = 0 });
        world.AddStatic(AssetFractals.Load(fractal, depth));
        world.AddStatic(PhysicsMeshes.FloorMesh(), Samples.Move(0, -0.6, 0));
        AddBodies(world, radius);
        return world;
    }

    private static void AddBodies(PhysicsWorld world, double radius)
    {
        var random = new Random(1);
        world.AddRange(Enumerable.Range(0, 25).Select(i =>
        {
            var position = new Vector((i % 5 * 0.2) - 0.4, 0.6, (i / 5 % 5 * 0.2) - 0.4) + random.Vector(0.01);
            return new BodyDescription(position, radius)
            {
                Restitution = i % 3 * 0.4, Friction = i % 2 * 0.3, Damping = i % 4 * 0.05, Shrinkage = i % 7 == 0 ? 0.01 : 0,
            };
        }));
    }

    private static Action<int> CreateSkew()
    {
        var skew = Samples.Move(0, -0.2, 0) with { Rotation = new(20, 30, 40), Scale = new(1, 0.4, -0.7) };
        var world = TestWorlds.Create(TestWorlds.Gravity, 1 / 60.0, TestWorlds.Place(PhysicsMeshes.Cube, skew),
            TestWorlds.Place(PhysicsMeshes.Scale(PhysicsMeshes.InwardCube, 4)));
        AddBodies(world, 0.06);
        return StepsOf(world, static (world, step) =>
        {
            if (step % 60 == 59)
            {
                world.SetVelocity(world.Bodies[step / 60], new(0.3, 3, 0.2));
            }

            world.Step();
        });
    }

    private static Action<int> CreateCharacter()
    {
        var world = CreateWorld("menger", 3, 0.04);
        var character = world.AddCharacter(new(new(0.2, 1, 0.1), 0.04, 0.2));
        character.IsActive = true;
        return StepsOf(world, (world, step) =>
        {
            character.MoveInput = new(Math.Cos(0.01 * step), 0, Math.Sin(0.01 * step));
            if (step % 40 == 0)
            {
                character.Jump();
            }

            world.Step();
        });
    }

    private static PhysicsWorld CreateCompounds()
    {
        var world = new PhysicsWorld(new PhysicsSettings { MaxThreads = 1 });
        world.AddStatic(AssetFractals.Load("menger", 3));
        var random = new Random(1);
        world.AddRange(Enumerable.Range(0, 400).Select(i =>
        {
            var position = new Vector(random.Between(-0.5, 0.5), random.Between(0.6, 1.4), random.Between(-0.5, 0.5));
            return i % 10 == 0
                ? new(position, CompoundShape.Capsule(-0.02 * Vector.I, 0.02 * Vector.I, 0.015)) { Friction = 0.3 }
                : new BodyDescription(position, 0.015) { Restitution = i % 3 * 0.3, Friction = i % 2 * 0.3 };
        }));
        return world;
    }

    private static PhysicsWorld CreateHeap(int maxThreads)
    {
        var settings = new PhysicsSettings { MaxThreads = maxThreads };
        var world = TestWorlds.Create(TestWorlds.Gravity, settings, TestWorlds.Place(PhysicsMeshes.FloorMesh()));
        var random = new Random(3);
        world.AddRange(Enumerable.Range(0, 1000).Select(i => new BodyDescription(
            new Vector(i % 12, 0.55 + (i / 96), i / 12 % 8) + random.Vector(0.03), 0.5)
        {
            Friction = 0.5, RollingFriction = i % 2 * 0.02,
        }));
        return world;
    }

    private static PhysicsWorld CreateMill()
    {
        var world = new PhysicsWorld();
        world.AddStatic(PhysicsMeshes.FloorMesh());
        world.AddStatic(PhysicsMeshes.Cube, new(new(0, 1, 0), Vector.Zero, new(6, 2, 0.2))).SetMotion(Vector.Zero, new(0, 3, 0));
        world.AddStatic(PhysicsMeshes.Cube, new(new(0, -0.4, 5), Vector.Zero, new(9, 1, 3))).SetBelt(new(0, 0, -3));
        world.AddRange(Enumerable.Range(0, 12).Select(static i => new BodyDescription(
            new((0.8 * i) - 4.4, 2 + (0.1 * i), i % 2 == 0 ? 1.5 : -1.5), 0.3)
        {
            Friction = 0.4, Restitution = 0.3, RollingFriction = 0.02,
        }));
        return world;
    }

    private static PhysicsWorld CreateReporting()
    {
        var world = new PhysicsWorld(new PhysicsSettings { ReportsContacts = true, SleepSpeed = 0 });
        world.AddStatic(PhysicsMeshes.Cube, new(new(0, -0.5, 0), Vector.Zero, new(20, 1, 20)));
        world.AddStatic(Shapes.Box(new(new(-1, 1, -1), new(1, 3, 1)))).IsTrigger = true;
        world.AddRange(Enumerable.Range(0, 20).Select(static i => new BodyDescription(new(0.01 * i, (1.1 * i) + 0.5, 0), 0.5)
        {
            Restitution = 0.5, Friction = 0.3,
        }));
        return world;
    }
}
