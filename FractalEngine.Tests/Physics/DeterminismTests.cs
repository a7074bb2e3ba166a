using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics;
using FractalEngine.Tests.Collision;

namespace FractalEngine.Tests.Physics;

/// <summary>The same steps give the same bits.</summary>
public class DeterminismTests
{
    [Fact]
    public void StateHash_OfTheSameWorld_IsTheSameOnAllThreads()
    {
        var expected = Hashes(World());
        var hashes = new string[6][];
        // Others at the same time, each a little further on than the next.
        Parallel.For(0, hashes.Length, i =>
        {
            var other = World();
            other.Run(10 * i);
            hashes[i] = Hashes(World());
        });
        Assert.All(hashes, other => Assert.Equal(expected, other));
        Assert.Equal(expected.Length, expected.Distinct().Count());
    }

    [Fact]
    public void StateHash_AfterReset_IsThatOfTheFirstRun()
    {
        var world = SceneWorld();
        var start = world.StateHash;
        var expected = Hashes(world);
        world.Add(new(new(0.1, 0.8, 0.1), 0.05) { Velocity = new(1, 2, 3) });
        world.SetForce(world.Bodies[0], new(1, 2, 3));
        world.Run(50);
        world.Reset();
        Assert.Equal((start, 0L, 0.0, 6), (world.StateHash, world.StepCount, world.Time, world.Bodies.Count));
        Assert.Equal(expected, Hashes(world));
    }

    [Fact]
    public void StateHash_OfAnotherPlace_Differs()
    {
        var (world, other) = (World(), World());
        other.SetVelocity(other.Bodies[0], other.Bodies[0].Velocity + new Vector(0, 1e-15, 0));
        Assert.NotEqual(world.StateHash, other.StateHash);
    }

    [Fact]
    public void Advance_InAnyPortions_MakesTheSameSteps()
    {
        var (world, other) = (World(), World());
        // Binary fractions, so that no time is lost to rounding: 1/64 a step.
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
        var world = World();
        Assert.Equal(world.Settings.MaxStepsPerAdvance, world.Advance(1000));
        Assert.Equal(0, world.Advance(-1));
        Assert.Equal(world.Settings.MaxStepsPerAdvance, world.StepCount);
    }

    private static string[] Hashes(PhysicsWorld world)
    {
        var hashes = new string[30];
        for (var i = 0; i < hashes.Length; i++)
        {
            world.Run(5);
            hashes[i] = world.StateHash;
        }

        return hashes;
    }

    private static PhysicsWorld World()
    {
        var world = TestWorlds.Create(TestWorlds.Gravity, 1 / 64.0, TestWorlds.Place(AssetFractals.Load("menger", 2)));
        var random = new Random(7);
        world.AddRange(Enumerable.Range(0, 12)
            .Select(i => new BodyDescription(new((i % 4 * 0.25) - 0.4, 0.7 + (0.1 * random.NextDouble()), (i / 4 * 0.3) - 0.3), 0.08)
        {
            Velocity = new(random.NextDouble(), 0, random.NextDouble()), Restitution = random.NextDouble(), Friction = i % 2 * 0.4,
            Damping = i % 3 * 0.1,
        }));
        return world;
    }

    /// <summary>The same bodies as objects of the scene.</summary>
    private static PhysicsWorld SceneWorld() => TestWorlds.Create(TestWorlds.Gravity, 1 / 64.0, [
        TestWorlds.Place(AssetFractals.Load("menger", 2)),
        .. Enumerable.Range(0, 6).Select(i => new Core.Scenes.PlacedModel(
            new Core.Scenes.PhysicsObject("cube.obj", Support.Samples.MoveAndScale((i * 0.15) - 0.4, 0.8, 0.01 * i, 0.1),
            0.7) { Velocity = new(0.3, 0, 0.2 * i) },
            new Core.Scenes.MeshModel(PhysicsMeshes.Cube))),
    ]);
}
