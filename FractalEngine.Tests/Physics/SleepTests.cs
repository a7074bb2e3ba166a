using FractalEngine.Core.Generation;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Physics;

/// <summary>Which bodies fall asleep and when, and who wakes whom.</summary>
public class SleepTests
{
    private static readonly PhysicsSettings Settings = new() { SleepSpeed = 0.1, TimeBeforeSleep = 0.5 };

    /// <summary>Without friction it slides and turns as it began, on an endless plane.</summary>
    [Fact]
    public void Ball_ThatMovesAndTurnsForEver_SleepsOnlyIfBothAreSlow() => Seeded.Run(60, random =>
    {
        var world = TestWorlds.Create(TestWorlds.Gravity, Settings, TestWorlds.Place(PhysicsMeshes.FloorMesh()));
        var radius = random.Between(0.05, 2);
        var (speed, spinning) = (Draw(), Draw());
        var direction = (random.Direction() with { Y = 0 }).UnitVector();
        var body = world.Add(new(new(0, radius, 0), radius)
        {
            Velocity = speed * direction, AngularVelocity = spinning / radius * random.Direction(), SpinningFriction = 0,
        });
        // It touches the ground at the end of the first step.
        world.Run(28);
        Assert.False(body.IsAsleep);
        world.Run(5);
        Assert.Equal(speed < 0.1 && spinning < 0.1, body.IsAsleep);
        if (!body.IsAsleep)
        {
            world.Run(60);
            Assert.False(body.IsAsleep);
            Near.Equal(body.Description.AngularVelocity, body.AngularVelocity, 1e-12);
            Near.Equal(body.Description.Velocity, body.Velocity, 1e-9);
        }

        double Draw() => random.Next(2) == 0 ? random.Between(0.0, 0.09) : random.Between(0.11, 3);
    });

    /// <summary>Sixteen steps of a 64th are a quarter of a second to the last bit.</summary>
    [Theory]
    [InlineData(1, false)]
    [InlineData(2, false)]
    [InlineData(1, true)]
    public void Sleep_OfWhatRestsFromTheBeginning_ComesAfterItsTime(int count, bool isCompound)
    {
        var world = TestWorlds.Create(
            TestWorlds.Gravity, new PhysicsSettings { TimeStep = 1 / 64.0, SleepSpeed = 0.1, TimeBeforeSleep = 0.25 },
            TestWorlds.Place(PhysicsMeshes.FloorMesh()));
        world.AddRange(Enumerable.Range(0, count).Select(i => isCompound
            ? new BodyDescription(new(0, 0.5, 0), CompoundShape.Capsule(-1 * Vector.I, Vector.I, 0.5)) : new(new(0, i + 0.5, 0), 0.5)));
        world.Run(15, () => Assert.All(world.Bodies, static body => Assert.False(body.IsAsleep)));
        world.Step();
        Assert.All(world.Bodies, static body => Assert.True(body.IsAsleep));
        Assert.False(world.IsMoving);
    }

    /// <summary>A plate that comes wakes a sleeper in the step in which it may reach it, and none before.</summary>
    [Fact]
    public void Plate_ThatComes_WakesASleeperInTheStepInWhichItArrives()
    {
        var world = TestWorlds.Create(TestWorlds.Gravity, Settings, TestWorlds.Place(PhysicsMeshes.FloorMesh()));
        var sleeper = world.AddSphere(new(0, 0.5, 0), 0.5);
        world.Run(60);
        var plate = world.AddStatic(PhysicsMeshes.Cube, new(new(-2.51, 1.1, 0), Vector.Zero, new(1, 2, 1)));
        world.Run(60);
        // The gap of 1.51 closes by 0.02 in each step.
        plate.SetMotion(new(1.2, 0, 0));
        sleeper.Sleep();
        world.Run(75, () => Assert.True(sleeper.IsAsleep, $"awake after {world.StepCount} steps"));
        world.Step();
        Assert.False(sleeper.IsAsleep);
    }

    /// <summary>A plate pushes a ball that then reaches a sleeper in the same step: both give way at once.</summary>
    [Fact]
    public void Ball_ThatAPlatePushesToASleeper_WakesItInTheSameStep()
    {
        var world = TestWorlds.Create(TestWorlds.Gravity, Settings, TestWorlds.Place(PhysicsMeshes.FloorMesh()));
        var sleeper = world.AddSphere(new(0, 0.5, 0), 0.5);
        var pushed = world.AddSphere(new(-1.01, 0.5, 0), 0.5);
        world.Run(20);
        world.AddStatic(PhysicsMeshes.Cube, new(new(-2.01, 1.1, 0), Vector.Zero, new(1, 2, 1))).SetMotion(new(1.2, 0, 0));
        sleeper.Sleep();
        world.Step();
        Assert.False(sleeper.IsAsleep);
        // The plate goes on by 0.02, of which 0.01 are the gap.
        Near.Equal(new(-0.99, 0.5, 0), pushed.Position, 1e-5);
        Near.Equal(new(0.01, 0.5, 0), sleeper.Position, 1e-5);
    }

    [Fact]
    public void Ball_ThatFloats_NeverSleeps()
    {
        var world = TestWorlds.Create(Vector.Zero, Settings);
        var body = world.AddSphere(Vector.Zero, 0.5);
        world.Run(120);
        Assert.False(body.IsAsleep);
    }

    [Theory]
    [InlineData(false)]
    [InlineData(true)]
    public void Spin_WithDamping_FallsExponentially(bool isCompound) => Seeded.Run(10, random =>
    {
        var rate = random.Between(0.1, 5);
        var world = TestWorlds.Create(Vector.Zero, random.Between(0.001, 0.05));
        // About the axis of a capsule, which then doesn't tumble.
        var description = isCompound
            ? new BodyDescription(Vector.Zero, CompoundShape.Capsule(-1 * Vector.I, Vector.I, 0.4)) { AngularVelocity = 3 * Vector.I }
            : new(Vector.Zero, 0.4) { AngularVelocity = random.Vector(5) };
        var body = world.Add(description with { Damping = rate });
        var start = body.AngularVelocity;
        // One rounding in each step.
        world.Run(100, () => Near.Equal(Math.Exp(-rate * world.Time) * start, body.AngularVelocity, 1e-11));
    });

    /// <summary>A ball is stuck in a slot, and another one lies on it. The lower one shrinks, and falls through when it fits.</summary>
    [Theory]
    [InlineData(0.05)]
    [InlineData(2)]
    public void Ball_OnOneThatShrinksInASlot_FollowsItAndFallsAfterIt(double shrinkage)
    {
        var slot = PhysicsMeshes.FromTriangles(
            PhysicsMeshes.PlaneTriangle(-0.5 * Vector.I, Vector.I), PhysicsMeshes.PlaneTriangle(0.5 * Vector.I, -1 * Vector.I));
        var world = TestWorlds.Create(TestWorlds.Gravity, Settings, TestWorlds.Place(slot));
        var lower = world.Add(new(Vector.Zero, 0.6) { Shrinkage = shrinkage, MinScale = 0.5 });
        var upper = world.Add(new(new(0, 0.8, 0), 0.2));
        // The upper one falls after the other from rest in each step.
        var lag = (0.6 * shrinkage / 60) + (9.8 / 3600);
        for (var step = 0; step < 600 && lower.Position.Y > -5; step++)
        {
            world.Step();
            if (lower.IsStuck)
            {
                Assert.InRange(upper.Position.Y - lower.Radius - 0.2, -1e-6, 3 * lag);
            }
        }

        Assert.True(lower.Position.Y <= -5, "it has not come free");
        Assert.InRange(lower.Radius, 0.3, 0.5);
        Assert.True(upper.Position.Y < -3, $"the upper one has stayed at {upper.Position.Y}");
    }

    /// <summary>A ball that comes to touch one that sleeps, at rest or in motion.</summary>
    /// <param name="speed">Speed at which it leaves.</param>
    /// <param name="shrinkage">Part of its size that it loses in a second.</param>
    /// <param name="wakes">What moves from where it touched another wakes it: that may have lost its support.</param>
    [Theory]
    [InlineData(0, 0, false)]
    [InlineData(30, 0, true)]
    [InlineData(0, 20, true)]
    public void Ball_BesideASleeper_WakesItIfItLeaves(double speed, double shrinkage, bool wakes)
    {
        var world = TestWorlds.Create(TestWorlds.Gravity, Settings, TestWorlds.Place(PhysicsMeshes.FloorMesh()));
        var sleeper = world.AddSphere(new(0, 0.5, 0), 0.5);
        world.Run(60);
        Assert.True(sleeper.IsAsleep);
        world.Add(new(new(1, 0.5, 0), 0.5) { Velocity = new(speed, 0, 0), Shrinkage = shrinkage, MinScale = 0.5 });
        world.Step();
        Assert.Equal(wakes, !sleeper.IsAsleep);
        world.Run(20);
        Assert.Equal(wakes, !sleeper.IsAsleep);
    }

    /// <summary>All balls of one of two rows that touch are woken, and none of the other.</summary>
    [Theory]
    [InlineData(1)]
    [InlineData(40)]
    [InlineData(300)]
    public void Push_OnOneOfManySleepersThatTouch_WakesAllOfItsRowAndNoOther(int count)
    {
        var world = TestWorlds.Create(TestWorlds.Gravity, Settings, TestWorlds.Place(Shapes.Box(new(new(-400, -1, -9), new(400, 0, 9)))));
        world.AddRange(from z in new[] { 0, 3 }
                       from i in Enumerable.Range(0, count)
                           // Those of heaps rest up to a thousandth of a radius apart.
                       let position = new Vector(1.0004 * (i - (0.5 * count)), 0.5, z)
                       select new BodyDescription(position, 0.5) { Friction = 0.5, RollingFriction = 0.1 });
        for (var step = 0; step < 300 && world.IsMoving; step++)
        {
            world.Step();
        }

        Assert.All(world.Bodies, static body => Assert.True(body.IsAsleep));
        world.ApplyImpulse(world.Bodies[count / 2], 0.001 * Vector.I);
        Assert.All(world.Bodies, body => Assert.Equal(body.Index >= count, body.IsAsleep));
    }
}
