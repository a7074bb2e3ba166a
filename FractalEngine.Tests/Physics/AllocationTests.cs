using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics;
using FractalEngine.Tests.Collision;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Physics;

/// <summary>A step allocates nothing once everything is built.</summary>
public class AllocationTests
{
    [Fact]
    public void Step_WithBodiesOnAFractal_AllocatesNothing()
    {
        var world = TestWorlds.Create(TestWorlds.Gravity, new PhysicsSettings { SleepSpeed = 0 },
            TestWorlds.Place(AssetFractals.Load("menger", 3)),
            TestWorlds.Place(PhysicsMeshes.FloorMesh(), Samples.Move(0, -0.6, 0)));
        AddBodies(world, 0.04);
        CheckSteps(world);
    }

    [Fact]
    public void Step_WithBodiesOnAnInfiniteFractal_AllocatesNothing()
    {
        var world = TestWorlds.Create(TestWorlds.Gravity, new PhysicsSettings { SleepSpeed = 0 },
            TestWorlds.Place(AssetFractals.Load("infinite-menger")),
            TestWorlds.Place(PhysicsMeshes.FloorMesh(), Samples.Move(0, -0.6, 0)));
        AddBodies(world, 0.06);
        CheckSteps(world);
    }

    [Fact]
    public void Step_WithSkewObjectsAndSleepers_AllocatesNothing()
    {
        var skew = Samples.Move(0, -0.2, 0) with { Rotation = new(20, 30, 40), Scale = new(1, 0.4, -0.7) };
        var world = TestWorlds.Create(TestWorlds.Gravity, 1 / 60.0, TestWorlds.Place(PhysicsMeshes.Cube, skew),
            TestWorlds.Place(PhysicsMeshes.Scale(PhysicsMeshes.InwardCube, 4)));
        AddBodies(world, 0.06);
        CheckSteps(world);
    }

    private static void AddBodies(PhysicsWorld world, double radius)
    {
        var random = new Random(1);
        world.AddRange(Enumerable.Range(0, 25)
            .Select(i => new BodyDescription(new Vector((i % 5 * 0.2) - 0.4, 0.6, (i / 5 % 5 * 0.2) - 0.4) + random.Vector(0.01), radius)
        {
            Restitution = i % 3 * 0.4, Friction = i % 2 * 0.3, Damping = i % 4 * 0.05, Shrinkage = i % 7 == 0 ? 0.01 : 0,
        }));
    }

    private static void CheckSteps(PhysicsWorld world)
    {
        // Long enough for the runtime to have compiled everything as well as it ever does, and for lists to be as long as they get.
        _ = RunAndCountAwake(world, 300);
        var before = GC.GetAllocatedBytesForCurrentThread();
        var awake = RunAndCountAwake(world, 1000);
        Assert.Equal(0, GC.GetAllocatedBytesForCurrentThread() - before);
        Assert.True(awake > 50, "all sleep");
    }

    private static int RunAndCountAwake(PhysicsWorld world, int steps)
    {
        var awake = 0;
        for (var step = 0; step < steps; step++)
        {
            if (step % 60 == 0)
            {
                world.SetVelocity(world.Bodies[step / 60], new(0.3, 3, 0.2));
            }

            world.Step();
            awake += world.Bodies[step % world.Bodies.Count].IsAsleep ? 0 : 1;
        }

        return awake;
    }
}
