using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics;
using FractalEngine.Tests.Collision;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Physics;

/// <summary>A step allocates nothing once everything is built.</summary>
public class AllocationTests
{
    private const int CountedSteps = 250;

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
    public void Step_WithBodiesOnAnInfiniteFractal_AllocatesNothing() => CheckInfiniteFractal(CountedSteps);

    [Fact]
    [Trait("Category", "Soak")]
    public void ManySteps_WithBodiesOnAnInfiniteFractal_AllocateNothing() => CheckInfiniteFractal(1000);

    [Fact]
    public void Step_WithSkewObjectsAndSleepers_AllocatesNothing()
    {
        var skew = Samples.Move(0, -0.2, 0) with { Rotation = new(20, 30, 40), Scale = new(1, 0.4, -0.7) };
        var world = TestWorlds.Create(TestWorlds.Gravity, 1 / 60.0, TestWorlds.Place(PhysicsMeshes.Cube, skew),
            TestWorlds.Place(PhysicsMeshes.Scale(PhysicsMeshes.InwardCube, 4)));
        AddBodies(world, 0.06);
        CheckSteps(world);
    }

    [Fact]
    public void Step_OfVaryingLengths_AllocatesNothing()
    {
        var world = new PhysicsWorld(new PhysicsSettings { SleepSpeed = 0 });
        world.AddStatic(AssetFractals.Load("menger", 3));
        world.AddStatic(PhysicsMeshes.FloorMesh(), Samples.Move(0, -0.6, 0));
        AddBodies(world, 0.04);
        CheckSteps(world, step => world.Step((1 + (step % 7)) / 240.0));
    }

    [Fact]
    public void Step_WithAWalkingCharacter_AllocatesNothing()
    {
        var world = new PhysicsWorld();
        world.AddStatic(AssetFractals.Load("menger", 3));
        world.AddStatic(PhysicsMeshes.FloorMesh(), Samples.Move(0, -0.6, 0));
        AddBodies(world, 0.04);
        var character = world.AddCharacter(new(new(0.2, 1, 0.1), 0.04, 0.2));
        character.IsActive = true;
        CheckSteps(world, step =>
        {
            character.MoveInput = new(Math.Cos(0.01 * step), 0, Math.Sin(0.01 * step));
            if (step % 40 == 0)
            {
                character.Jump();
            }

            world.Step();
        });
    }

    private static void CheckInfiniteFractal(int steps)
    {
        var world = TestWorlds.Create(TestWorlds.Gravity, new PhysicsSettings { SleepSpeed = 0 },
            TestWorlds.Place(AssetFractals.Load("infinite-menger")),
            TestWorlds.Place(PhysicsMeshes.FloorMesh(), Samples.Move(0, -0.6, 0)));
        AddBodies(world, 0.06);
        CheckSteps(world, steps: steps);
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

    private static void CheckSteps(PhysicsWorld world, Action<int>? makeStep = null, int steps = CountedSteps)
    {
        makeStep ??= _ => world.Step();
        // Until the runtime has compiled everything to its last tier, and lists have reached their final lengths.
        _ = RunAndCountAwake(world, 300, makeStep);
        var before = GC.GetAllocatedBytesForCurrentThread();
        var awake = RunAndCountAwake(world, steps, makeStep);
        Assert.Equal(0, GC.GetAllocatedBytesForCurrentThread() - before);
        Assert.True(awake > steps / 20, "all sleep");
    }

    private static int RunAndCountAwake(PhysicsWorld world, int steps, Action<int> makeStep)
    {
        var awake = 0;
        for (var step = 0; step < steps; step++)
        {
            if (step % 60 == 0)
            {
                world.SetVelocity(world.Bodies[step / 60], new(0.3, 3, 0.2));
            }

            makeStep(step);
            awake += world.Bodies[step % world.Bodies.Count].IsAsleep ? 0 : 1;
        }

        return awake;
    }
}
