using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Core.Scenes;
using FractalEngine.Tests.Colliders;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Physics;

/// <summary>The same steps give the same bits, whatever else runs.</summary>
public class DeterminismTests
{
    [Fact]
    public void StateHash_OfTheSameWorld_IsTheSameOnAllThreads()
    {
        var expected = HashesWhileRunning(CreateWorld());
        var hashes = new string[6][];
        // Each thread first steps another world, for a different number of steps.
        Parallel.For(0, hashes.Length, i =>
        {
            var other = CreateWorld();
            other.Run(10 * i);
            hashes[i] = HashesWhileRunning(CreateWorld());
        });
        Assert.All(hashes, other => Assert.Equal(expected, other));
        Assert.Equal(expected.Length, expected.Distinct().Count());
    }

    [Fact]
    public void StateHash_OfAHeap_IsTheSameOnAnyNumberOfThreads()
    {
        var expected = HashesWhileRunning(CreateHeap(1));
        Assert.Equal(expected, HashesWhileRunning(CreateHeap(2)));
        Assert.Equal(expected, HashesWhileRunning(CreateHeap(5)));
    }

    [Fact]
    public void StateHash_AfterReset_IsThatOfTheFirstRun()
    {
        var world = CreateSceneWorld();
        var start = world.StateHash;
        var expected = HashesWhileRunning(world);
        world.AddSphere(new(0.1, 0.8, 0.1), 0.05, velocity: new(1, 2, 3));
        world.SetForce(world.Bodies[0], new(1, 2, 3));
        world.ApplyImpulse(world.Bodies[1], 0.01 * Vector.I, world.Bodies[1].Position + (0.05 * Vector.J));
        world.Run(50);
        Assert.NotEqual(Orientation.Identity, world.Bodies[1].Orientation);
        world.Reset();
        Assert.Equal((start, 0L, 0.0, 6), (world.StateHash, world.StepCount, world.Time, world.Bodies.Count));
        // Drawn between the step before and the next one, bodies stand still.
        Assert.All(world.Bodies, body => Assert.Equal(body.InterpolatedMap(1), body.InterpolatedMap(0)));
        Assert.Equal(expected, HashesWhileRunning(world));
    }

    [Fact]
    public void StateHash_OfAnotherVelocity_Differs()
    {
        var (world, other) = (CreateWorld(), CreateWorld());
        other.SetVelocity(other.Bodies[0], other.Bodies[0].Velocity + new Vector(0, 1e-15, 0));
        Assert.NotEqual(world.StateHash, other.StateHash);
    }

    [Fact]
    public void Advance_InAnyPortions_MakesTheSameSteps()
    {
        var (world, other) = (CreateWorld(), CreateWorld());
        // Steps of 1/64 s, a binary fraction, so that rounding loses no time.
        for (var i = 0; i < 200; i++)
        {
            world.Advance(1 / 64.0);
            other.Advance(1 / 128.0);
            other.Advance(1 / 128.0);
        }

        Assert.Equal((200L, 200L, world.StateHash), (world.StepCount, other.StepCount, other.StateHash));
    }

    [Fact]
    public void Advance_ByALongTime_MakesNoMoreStepsThanAllowed()
    {
        var world = CreateWorld();
        Assert.Equal(world.Settings.MaxStepsPerAdvance, world.Advance(1000));
        Assert.Equal(0, world.Advance(-1));
        Assert.Equal(world.Settings.MaxStepsPerAdvance, world.StepCount);
        Assert.Equal(1, new PhysicsWorld(new PhysicsSettings { MaxStepsPerAdvance = 1 }).Advance(1000));
    }

    private static string[] HashesWhileRunning(PhysicsWorld world)
    {
        var hashes = new string[30];
        for (var i = 0; i < hashes.Length; i++)
        {
            world.Run(5);
            hashes[i] = world.StateHash;
        }

        return hashes;
    }

    private static PhysicsWorld CreateWorld()
    {
        var world = TestWorlds.Create(TestWorlds.Gravity, 1 / 64.0, TestWorlds.Place(AssetFractals.Load("menger", 2)));
        var random = new Random(7);
        for (var i = 0; i < 12; i++)
        {
            world.Add(new(new((i % 4 * 0.25) - 0.4, 0.7 + (0.1 * random.NextDouble()), (i / 4 * 0.3) - 0.3), 0.08)
            {
                Velocity = new(random.NextDouble(), 0, random.NextDouble()),
                Restitution = random.NextDouble(),
                Friction = i % 2 * 0.4,
                Damping = i % 3 * 0.1,
            });
        }

        return world;
    }

    /// <summary>So many balls that threads share the parts of their island.</summary>
    private static PhysicsWorld CreateHeap(int maxThreads)
    {
        var settings = new PhysicsSettings { MaxThreads = maxThreads };
        var world = TestWorlds.Create(TestWorlds.Gravity, settings, TestWorlds.Place(PhysicsMeshes.FloorMesh()));
        var random = new Random(3);
        world.AddRange(Enumerable.Range(0, 700).Select(i => new BodyDescription(
            new Vector(i % 12, 0.55 + (i / 96), i / 12 % 8) + random.Vector(0.03), 0.5)
        {
            Friction = 0.5, RollingFriction = i % 2 * 0.02,
        }));
        return world;
    }

    /// <summary>A world whose bodies are objects of the scene.</summary>
    private static PhysicsWorld CreateSceneWorld()
    {
        var cube = new MeshModel(PhysicsMeshes.Cube);
        var bodies = Enumerable.Range(0, 6).Select(i => new PhysicsObject(cube, 0.7)
        {
            Placement = Samples.MoveAndScale((i * 0.15) - 0.4, 0.8, 0.01 * i, 0.1), Velocity = new(0.3, 0, 0.2 * i),
        });
        return new(
            new Scene { Objects = [new SceneObject(AssetFractals.Load("menger", 2)), .. bodies] },
            new PhysicsSettings { TimeStep = 1 / 64.0 });
    }
}
