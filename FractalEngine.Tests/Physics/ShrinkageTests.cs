using FractalEngine.Core.Maths;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Physics;

/// <summary>Bodies that shrink as they move (paper §5.5).</summary>
public class ShrinkageTests
{
    [Fact]
    public void Radius_OfAShrinkingBody_FallsLinearlyToItsMinimum() => Seeded.Run(20, random =>
    {
        var radius = random.Between(0.1, 2);
        var rate = random.Between(0.05, 2);
        var minimumScale = random.Between(0.05, 0.9);
        var world = TestWorlds.Create(TestWorlds.Gravity, random.Between(0.005, 0.1), TestWorlds.Place(PhysicsMeshes.FloorMesh()));
        var body = world.Add(new(new(0, 5, 0), radius) { Shrinkage = rate, MinScale = minimumScale, Restitution = 0.5 });
        world.Run((int)(2 / world.Settings.TimeStep), () =>
        {
            // Hundreds of subtractions, each rounded.
            Near.Equal(radius * Math.Max(minimumScale, 1 - (rate * world.Time)), body.Radius, 1e-12);
            Assert.True(body.Position.Y >= body.Radius * (1 - 1e-6));
        });
    });

    [Fact]
    public void ShrinkingBody_OnAFloor_StaysOnIt()
    {
        var world = TestWorlds.Create(TestWorlds.Gravity, 1 / 60.0, TestWorlds.Place(PhysicsMeshes.FloorMesh()));
        var body = world.Add(new(new(0, 1, 0), 1) { Shrinkage = 0.1, MinScale = 0.2 });
        world.Run(700, () =>
        {
            // Its radius falls by 0.1/60 in a step, and from rest it falls by ½·9.8/60² = 0.0014 in one: it is a step or two behind.
            Assert.InRange(body.Position.Y - body.Radius, -1e-6, 3 * 0.1 / 60);
        });
        Assert.True(body.IsAsleep);
        Near.Equal(0.2, body.Position.Y, 1e-6);
    }

    /// <summary>The funnel has a hole of radius 0.5 at y = 0, and walls at 45°.</summary>
    [Fact]
    public void ShrinkingBody_InAFunnel_FallsThroughWhenItFits()
    {
        const int Sides = 24;
        var faces = Enumerable.Range(0, Sides).SelectMany(i =>
        {
            var a = RingVertex(0.5, 0, i);
            var b = RingVertex(0.5, 0, i + 1);
            var c = RingVertex(3, 2.5, i);
            var d = RingVertex(3, 2.5, i + 1);
            return new[] { (a, b, c), (b, d, c) };
        }).ToArray();
        var world = TestWorlds.Create(TestWorlds.Gravity, 1 / 120.0, TestWorlds.Place(PhysicsMeshes.FromTriangles(faces)));
        var body = world.Add(new(new(0.3, 3, 0.2), 1) { Shrinkage = 0.05, MinScale = 0.1 });
        var oracle = new SphereTriangleOracle(faces);
        while (body.Position.Y > -1 && world.Time < 20)
        {
            world.Step();
            Assert.True(oracle.Distance(body.Position) >= body.Radius * (1 - 1e-6), $"overlaps at {body.Position}, radius {body.Radius:R}");
        }

        // The sides of the hole are as close as 0.5·cos(π/24) = 0.496, and from there the fall takes less than a second.
        Assert.InRange(body.Radius, 0.496 - 0.05, 0.5);
        Assert.InRange(body.Position.Y, -2, -1);
    }

    [Fact]
    public void ShrinkingBody_ThatIsStuck_ComesFree()
    {
        var world = TestWorlds.Create(TestWorlds.Gravity, 1 / 60.0, TestWorlds.Place(PhysicsMeshes.InwardCube));
        var body = world.Add(new(Vector.Zero, 0.7) { Shrinkage = 0.5, MinScale = 0.3 });
        world.Step();
        Assert.True(body.IsStuck);
        world.Run(240);
        Assert.False(body.IsStuck);
        Near.Equal(-0.5 + body.Radius, body.Position.Y, 1e-6);
    }

    [Fact]
    public void ShrinkageOverride_OfAWorld_IsThatOfAllBodiesUntilItIsNull()
    {
        var world = TestWorlds.Create(TestWorlds.Gravity, 1 / 64.0, TestWorlds.Place(PhysicsMeshes.FloorMesh()));
        var still = world.Add(new(new(0, 1, 0), 1));
        var shrinking = world.Add(new(new(9, 1, 0), 1) { Shrinkage = 0.25 });
        world.ShrinkageOverride = 0;
        world.Run(64);
        Assert.Equal((1, 1), (still.Scale, shrinking.Scale));
        Assert.True(still.IsAsleep && shrinking.IsAsleep);
        world.ShrinkageOverride = 0.5;
        var added = world.Add(new(new(-9, 1, 0), 1) { MinScale = 0.75 });
        world.Run(64);
        // Binary fractions, which add up without rounding.
        Assert.Equal((0.5, 0.5, 0.75), (still.Scale, shrinking.Scale, added.Scale));
        world.ShrinkageOverride = null;
        world.Run(64);
        Assert.Equal((0.5, 0.25), (still.Scale, shrinking.Scale));
        Assert.Throws<ArgumentException>(() => world.ShrinkageOverride = -0.1);
        Assert.Throws<ArgumentException>(() => world.ShrinkageOverride = double.NaN);
        Assert.Throws<ArgumentException>(() => world.ShrinkageOverride = double.PositiveInfinity);
        Assert.Null(world.ShrinkageOverride);
    }

    [Fact]
    public void InterpolatedMap_OfAFraction_LiesBetweenTheSteps() => Seeded.Run(20, random =>
    {
        var world = TestWorlds.Create(TestWorlds.Gravity, 0.02);
        var axes = random.Orthogonal();
        var body = world.Add(new(random.Vector(), 0.5) { Velocity = random.Vector(5), Shrinkage = 0.3, LinearPart = axes });
        world.Run(random.Next(1, 30));
        var position = body.Position;
        var scale = body.Scale;
        Near.Equal(position, body.InterpolatedMap(1).Translation, 1e-14 * 10);
        world.Step();
        foreach (var alpha in new[] { 0, 0.25, 0.7, 1 })
        {
            // A few roundings of numbers below ten.
            Near.Equal(((1 - alpha) * position) + (alpha * body.Position), body.InterpolatedMap(alpha).Translation, 1e-13);
            Near.Equal((((1 - alpha) * scale) + (alpha * body.Scale)) * axes, body.InterpolatedMap(alpha).Linear, 1e-13);
        }
    });

    private static Vector RingVertex(double radius, double height, int i) =>
        new(radius * Math.Cos(i * Math.PI / 12), height, radius * Math.Sin(i * Math.PI / 12));
}
