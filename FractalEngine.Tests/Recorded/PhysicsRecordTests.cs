using FractalEngine.Core.Colliders;
using FractalEngine.Core.Generation;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Tests.Colliders;
using FractalEngine.Tests.Physics;
using static FractalEngine.Tests.Recorded.RecordedWorlds;

namespace FractalEngine.Tests.Recorded;

/// <summary>Small worlds of all kinds for some steps: where all is, and what it cost to find that.</summary>
public class PhysicsRecordTests
{
    // The number of steps that are looked at: so few that last digits don't grow to more than the tolerance.
    private static readonly int[] Few = [1, 2, 10, 40];
    private static readonly int[] Fewer = [1, 3, 12];

    [Fact]
    public void Balls_OnPlanesAndInCorners() => RecordedText.Check("physics-balls.txt",
    [
        .. Record("fall", OnFloor(Ball(new(0, 1, 0), 0.5, 1)), Few),
        .. Record("bounce", OnFloor([.. Enumerable.Range(0, 6).Select(i =>
            Ball(new(2 * i, 0.7 + (0.1 * i), 0), 0.3, i) with { Velocity = new(i, -3 - i, 0.5 * i), Restitution = 0.2 * i })]), Few),
        .. Record("roll", OnFloor([.. Enumerable.Range(0, 8).Select(i => Ball(new(0, 0.2 + (0.05 * i), 2 * i), 0.2 + (0.05 * i), i) with
        {
            Velocity = new(3, 0, 0.2 * i), AngularVelocity = new(i, 2 - i, 3), Friction = 0.1 * i, RollingFriction = 0.02 * (i % 3),
            SpinningFriction = 0.03 * (i % 4), Damping = 0.1 * (i % 2), IsRotationLocked = i == 7,
        })]), [1, 2, 10, 80]),
        .. Record("slope", Sloped([.. Enumerable.Range(0, 5).Select(i =>
            Ball(new(0, 0.31, i), 0.3, i) with { Friction = 0.15 * i, RollingFriction = 0.04 * i })]), Few),
        .. Record("corner", World(InwardBox(3), new(1, 2, 3), null, Balls(1, 6, 0.9)), Few),
        .. Record("edge", Over([PhysicsMeshes.Cube], Ball(new(0.52, 0.8, 0.1), 0.3, 2), Ball(new(-0.3, 1.2, 0.49), 0.2, 3),
            Ball(new(-0.55, 0.9, -0.52), 0.25, 5)), Few),
        .. Record("sphere", Over([Shapes.Sphere(2)], Ball(new(0.1, 1.3, 0.05), 0.3, 2), Ball(new(-0.3, 1.6, 0.3), 0.1, 3)), Few),
        .. Record("groove", Over([Groove(0.6), Groove(0.2)], Balls(3, 4, 1.5)), Few),
        .. Record("elastic", World(InwardBox(3), Vector.Zero, null, [.. Balls(5, 8, 1).Select(static ball =>
            ball with { Restitution = 1, Friction = 0, Damping = 0 })]), Few),
        .. Record("grazing", World([Shapes.Sphere(1), PhysicsMeshes.FloorMesh()], Vector.Zero, null,
            Ball(new(-3, 1.21, 0), 0.3, 2) with { Velocity = new(30, 0, 0) },
                Ball(new(-3, 0.2, 3), 0.2, 2) with { Velocity = new(90, 0, 0) }), Fewer),
        .. Record("thin", Over([PhysicsMeshes.FloorMesh(0.3)],
            Ball(new(0.1, 3, 0), 0.05, 2) with { Velocity = new(0, -900, 0), Restitution = 0.5 }), Fewer),
        .. Record("far", Over([PhysicsMeshes.FloorMesh(1e7)], Ball(new(1e5, 0.6, 2e5), 0.5, 2),
            Ball(new(1e5 + 1.2, 0.6, 2e5), 0.5, 3)), Few),
    ]);

    [Fact]
    public void Balls_OnFractals() => RecordedText.Check("physics-fractals.txt",
    [
        .. new[] { ("menger", 2), ("sierpinski", 4), ("tree", 3), ("terrain", 3), ("snowflake", 2), ("romanesco", 2), ("mountain",
            3) }.SelectMany(
            static pair => Record(pair.Item1, AboveFractal(AssetFractals.Load(pair.Item1, pair.Item2), 5), [1, 10, 40])),
        .. Record("endless", AboveFractal(AssetFractals.Load("infinite-menger"), 3), [1, 10, 30]),
        .. new[] { ColliderKind.Fractal, ColliderKind.BoundingBox, ColliderKind.Simple, ColliderKind.Hierarchy }.SelectMany(static kind =>
        {
            var world = AboveFractal(PhysicsMeshes.CreateSponge(2), 4);
            world.ColliderOverride = kind;
            return Record($"{kind}", world, [1, 10, 30]);
        }),
    ]);

    [Fact]
    public void Balls_ThatMeetEachOther() => RecordedText.Check("physics-meetings.txt",
    [
        .. Record("pair", Free(Ball(Vector.Zero, 0.5, 2), Ball(new(1.5, 0.2, 0.1), 0.3, 3) with
        {
            Velocity = new(-9, 0, 1), AngularVelocity = new(3, 4, 5),
        }), Few),
        .. Record("touching", Free(Ball(Vector.Zero, 0.5, 2), Ball(new(0.8, 0, 0), 0.3, 3) with { Velocity = new(-1, 1, 0) }), Few),
        .. Record("cloud", Free([.. Balls(11, 40, 1.6).Select(static ball => ball with { Velocity = -3 * ball.Position })]), Fewer),
        .. Record("stack", OnFloor([.. Enumerable.Range(0, 6).Select(static i => Ball(new(0, 0.5 + i, 0), 0.5, i))]), [1, 2, 10, 60]),
        .. Record("row", OnFloor([.. Enumerable.Range(0, 8).Select(static i =>
            Ball(new(i, 0.5, 0), 0.5, i) with { Velocity = new(i == 0 ? 4 : 0, 0, 0), Restitution = 0.9 })]), Few),
        .. Record("pyramid", OnFloor(Pyramid(4)), [1, 2, 10, 30]),
        .. Record("heap", Over(InwardBox(3), Balls(12, 50, 0.9)), Fewer),
        .. Record("heap in a sponge", World([], TestWorlds.Gravity, PhysicsMeshes.CreateSponge(2), Balls(13, 24, 0.4)), Fewer),
        .. Record("two heaps", OnFloor([.. Pyramid(3), .. Pyramid(3).Select(static ball =>
            ball with { Position = ball.Position + new Vector(9, 0, 2), Mass = 4 })]), Few),
        .. Record("light under heavy", OnFloor(Ball(new(0, 0.5, 0), 0.5, 1) with { Mass = 0.01 },
            Ball(new(0.05, 1.5, 0), 0.5, 2) with { Mass = 100 }), Few),
        .. Record("sizes", OnFloor(Ball(new(0, 5, 0), 5, 1), Ball(new(0.1, 10.06, 0), 0.05, 2), Ball(new(-0.2, 10.1, 0.1), 0.1, 2)), Few),
        .. Record("overlap", Over([PhysicsMeshes.FloorMesh(), PhysicsMeshes.Cube], Ball(new(0.5, 0.4, 0), 0.3, 1),
            Ball(new(0.7, 0.5, 0), 0.3, 2), Ball(new(3, -0.1, 0), 0.3, 3), Ball(new(3, 0.2, 0.1), 0.3, 4)), Few),
        .. Record("stuck", Over([Slot(0.8)], Ball(Vector.Zero, 0.5, 1), Ball(new(0, 0.8, 0), 0.2, 2)), Few),
        .. Record("layers", OnFloor([.. Pyramid(3).Select(static (ball, i) =>
            ball with { Layer = i % 3, Mask = i % 2 == 0 ? 3u : 7u })]), Few),
        .. Record("long steps", new PhysicsWorld(new PhysicsSettings { TimeStep = 0.1, RestitutionThreshold = 0.2,
            SleepSpeed = 0.05 }).Fill(
            [PhysicsMeshes.FloorMesh()], Pyramid(3)), Few),
    ]);

    [Theory]
    [InlineData("heap", 0)]
    [InlineData("slab", 1)]
    [InlineData("box", 2)]
    public void LargeIslands_OnOneAndMoreThreads_AreTheSame(string name, int kind)
    {
        string[] expected = [.. Record(name, CreateLarge(kind, 1), [1, 2, 5])];
        // All bits: the sums of both are the same texts.
        Assert.Equal(expected, Record(name, CreateLarge(kind, 4), [1, 2, 5]));
        RecordedText.Check($"physics-large-{name}.txt", expected);
    }

    [Fact]
    public void Compounds_AmongAllElse() => RecordedText.Check("physics-compounds.txt",
    [
        .. Record("flight", World([], new(0, -1, 0), null, Compound(Vector.Zero, Odd, 1) with { AngularVelocity = new(3, 4, -2) }), Few),
        .. Record("capsule", OnFloor(Compound(new(0, 0.6, 0), Bar, 2) with { AngularVelocity = new(0, 0, 3), Velocity = new(1, 0, 0) }),
            [1, 2, 10, 60]),
        .. Record("rolling", OnFloor(Compound(new(0, 0.25, 0), Bar, 2) with { Velocity = new(0, 0, 2), RollingFriction = 0.02 }), Few),
        .. Record("dumbbell", OnFloor(Compound(new(0, 1, 0), Dumbbell, 3) with { AngularVelocity = new(1, 5, 3), Restitution = 0.6 }), Few),
        .. Record("wall", World(InwardBox(2), new(3, -5, 2), null, Compound(Vector.Zero, Odd, 4) with { Velocity = new(4, 1, 0) }), Few),
        .. Record("standing", OnFloor(Compound(new(0, 0.7, 0), CompoundShape.Capsule(-0.45 * Vector.J, 0.45 * Vector.J, 0.25), 2)), Few),
        .. Record("locked", OnFloor(Compound(new(0, 0.5, 0), Bar, 2) with { IsRotationLocked = true, Velocity = new(2, 0, 1) }), Few),
        .. Record("edge", Over([PhysicsMeshes.Cube], Compound(new(0.4, 0.9, 0.1), Bar, 2)), Few),
        .. Record("sponge", World([], TestWorlds.Gravity, PhysicsMeshes.CreateSponge(2), Compound(new(0.1, 0.9, 0.1), Bar, 2),
            Compound(new(-0.3, 0.8, 0.1), Odd, 3)), Few),
        .. Record("pile", OnFloor(Compound(new(0, 0.25, 0), Bar, 2),
            Compound(new(0, 0.75, 0.1), Bar, 3) with { AngularVelocity = new(0, 1, 0) },
            Ball(new(0.2, 1.3, 0.1), 0.3, 4), Compound(new(0.1, 1.9, 0), Odd, 5)), Few),
        .. Record("meeting", Free(Compound(Vector.Zero, Bar, 2), Compound(new(1.2, 0.3, 0.3), Odd, 3) with { Velocity = new(-5, 0, 0) },
            Ball(new(-1, 0.2, 0), 0.2, 3) with { Velocity = new(6, 0, 0) }), Few),
        .. Record("shrinking", OnFloor(Compound(new(0, 0.4, 0), Bar, 2) with { Shrinkage = 0.5, MinScale = 0.6 },
            Compound(new(0, 1, 0), Odd, 3) with { Damping = 1 }), Few),
        .. Record("inside", Over([PhysicsMeshes.Cube], Compound(new(0.45, 0.3, 0), Bar, 2), Compound(new(0, 0.55, 0), Dumbbell, 3)), Few),
        .. Record("pile of bars", Over(InwardBox(2.4), [.. Enumerable.Range(0, 9).Select(static i =>
            Compound(new((0.3 * (i % 3)) - 0.3, -0.9 + (0.55 * (i / 3)), (0.55 * (i % 3)) - 0.6), i % 2 == 0 ? Bar : Dumbbell, i))]),
            [1, 10, 25]),
    ]);
}
