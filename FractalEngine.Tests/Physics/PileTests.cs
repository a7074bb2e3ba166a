using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Physics;

/// <summary>Piles of balls whose contacts are solved together.</summary>
public class PileTests
{
    // Relative to the energy: what moving overlapping balls apart lifts.
    private const double MaxRise = 1e-3;

    [Theory]
    [InlineData(0.01)]
    [InlineData(0.03)]
    [InlineData(0.1)]
    public void CrookedColumn_Falls_AsFastAsTheOracleSays(double offset)
    {
        var positions = PileOracleTests.CrookedColumn(offset);
        var expected = new PileOracle(positions, 0.5, 5e-4).MaxSpeedWithin(0.5);
        var world = CreatePile(positions);
        var maxSpeed = 0.0;
        world.Run(30, () => maxSpeed = Math.Max(maxSpeed, world.Bodies.Max(body => body.Velocity.Length())));
        Assert.InRange(maxSpeed, 0.95 * expected, 1.05 * expected);
        Assert.Equal(0, world.IslandStatistics.Unconverged);
    }

    [Fact]
    public void StraightColumn_OfTen_StandsForAMinute()
    {
        var positions = Enumerable.Range(0, 10).Select(i => new Vector(0, 0.5 + i, 0)).ToArray();
        var world = CreatePile(positions, sleepSpeed: null);
        world.Run(3600);
        for (var i = 0; i < positions.Length; i++)
        {
            Assert.InRange((world.Bodies[i].Position - positions[i]).Length(), 0, 1e-8);
        }
    }

    [Fact]
    public void Column_OfTen_WithOneAside_FallsAsFastAsTheOracleSays()
    {
        // A thousandth of its radius: the 4th ball stands aside, and all touch.
        const double Offset = 0.0005;
        var rise = Math.Sqrt(1 - (Offset * Offset));
        var positions = Enumerable.Range(0, 10)
            .Select(i => new Vector(i == 3 ? Offset : 0, 0.5 + Math.Min(i, 2) + (rise * Math.Clamp(i - 2, 0, 2)) + Math.Max(0, i - 4), 0))
            .ToArray();
        var expected = new PileOracle(positions, 0.5, 1e-3).MaxSpeedWithin(0.75);
        var world = CreatePile(positions);
        var maxSpeed = 0.0;
        world.Run(45, () => maxSpeed = Math.Max(maxSpeed, world.Bodies.Max(body => body.Velocity.Length())));
        Assert.InRange(maxSpeed, 0.95 * expected, 1.05 * expected);
        Assert.Equal(0, world.IslandStatistics.Unconverged);
    }

    [Fact]
    public void Heap_WithFriction_SleepsWithinTenSeconds()
    {
        var world = CreateHeap(0.5, isRotationLocked: false, sleepSpeed: null);
        for (var step = 0; step < 600 && world.IsMoving; step++)
        {
            world.Step();
        }

        Assert.False(world.IsMoving, $"{world.Bodies.Count(body => !body.IsAsleep)} are awake");
    }

    [Theory]
    [InlineData(0, true)]
    public void Heap_InABox_NeverGainsEnergy(double friction, bool isRotationLocked)
    {
        var world = CreateHeap(friction, isRotationLocked, sleepSpeed: 0);
        // From the floor of the box.
        double Energy() => world.Energy() + (9.8 * 8 * world.Bodies.Count);
        var energy = Energy();
        world.Run(600, () =>
        {
            var after = Energy();
            Assert.True(after <= energy * (1 + MaxRise), $"from {energy:R} to {after:R} in step {world.StepCount}");
            energy = after;
        });
        // Without friction, and where balls turn, jams are ill-conditioned: see the limits in docs/physics.md.
        Assert.True(
            friction == 0 || !isRotationLocked || world.IslandStatistics.Unconverged <= 0.001 * world.IslandStatistics.Solves,
            $"{world.IslandStatistics}");
    }

    [Theory]
    [InlineData(0.5, true)]
    [InlineData(0.5, false)]
    [Trait("Category", "Soak")]
    public void Heap_InABoxInOtherCases_NeverGainsEnergy(double friction, bool isRotationLocked) =>
        Heap_InABox_NeverGainsEnergy(friction, isRotationLocked);

    private static PhysicsWorld CreateHeap(double friction, bool isRotationLocked, double? sleepSpeed)
    {
        var random = new Random(5);
        var box = PhysicsMeshes.FlipWinding(PhysicsMeshes.Cube.Transform(v => (4 * v).Stretch(new(1, 4, 1))));
        var world = TestWorlds.Create(TestWorlds.Gravity, new PhysicsSettings { SleepSpeed = sleepSpeed }, TestWorlds.Place(box));
        world.AddRange(Enumerable.Range(0, 100).Select(i => new BodyDescription(
            new Vector(-1.5 + (i % 4 * 0.9), -7 + (i / 16 * 0.9), -1.5 + (i / 4 % 4 * 0.9)) + random.Vector(0.02), 0.4)
        {
            Friction = friction, IsRotationLocked = isRotationLocked,
        }));
        return world;
    }

    private static PhysicsWorld CreatePile(IEnumerable<Vector> positions, double? sleepSpeed = 0)
    {
        var world = TestWorlds.Create(
            TestWorlds.Gravity, new PhysicsSettings { SleepSpeed = sleepSpeed }, TestWorlds.Place(PhysicsMeshes.FloorMesh()));
        world.AddRange(positions.Select(position => new BodyDescription(position, 0.5)));
        return world;
    }
}
