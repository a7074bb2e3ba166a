using FractalEngine.Core.Maths;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Physics;

/// <summary>Ball against ball: the formulas for impacts along a line, and what is conserved in all others.</summary>
public class ImpactTests
{
    // Sums and products of a few numbers about 10.
    private const double Rounding = 1e-11;

    [Fact]
    public void HeadOn_WithAnyMasses_PartsAsTheFormulaSays() => Seeded.Run(300, random =>
    {
        var (m1, m2) = (Math.Pow(10, random.Between(-2, 2)), Math.Pow(10, random.Between(-2, 2)));
        var (e1, e2) = (random.NextDouble(), random.Next(3) == 0 ? 1 : random.NextDouble());
        var (v1, v2) = (random.Between(1, 10), random.Between(-10, 0.5));
        var direction = random.Direction();
        var world = TestWorlds.Create(Vector.Zero, Math.Pow(10, random.Between(-3, -1)));
        var body1 = world.Add(new(Vector.Zero, random.Between(0.1, 1)) { Mass = m1, Velocity = v1 * direction, Restitution = e1 });
        var body2 = world.Add(new(3 * direction, random.Between(0.1, 1)) { Mass = m2, Velocity = v2 * direction, Restitution = e2 });
        // Of both balls the one that bounces less decides.
        var e = Math.Min(e1, e2);
        var common = ((m1 * v1) + (m2 * v2)) / (m1 + m2);
        world.Run((int)(8 / world.Settings.TimeStep));
        Near.Equal((common - (m2 * e * (v1 - v2) / (m1 + m2))) * direction, body1.Velocity, 1e-9);
        Near.Equal((common + (m1 * e * (v1 - v2) / (m1 + m2))) * direction, body2.Velocity, 1e-9);
    });

    [Fact]
    public void Oblique_WithAnyMasses_KeepsMomentumAndReversesTheApproach() => Seeded.Run(300, random =>
    {
        var (m1, m2, e) = (random.Between(0.1, 10), random.Between(0.1, 10), random.Next(3) == 0 ? 1 : random.NextDouble());
        var world = TestWorlds.Create(Vector.Zero, Math.Pow(10, random.Between(-3, -1)));
        var target = random.Vector(3);
        var (u1, u2) = (random.Vector(10), random.Vector(10));
        // Both aim at one place, at most 0.8 apart there: balls of radius 0.5 meet.
        var body1 = world.Add(new(target - u1, 0.5) { Mass = m1, Velocity = u1, Restitution = e });
        var body2 =
            world.Add(new(target - u2 + (0.8 * random.NextDouble() * random.Direction()), 0.5) { Mass = m2, Velocity = u2,
            Restitution = e });
        if ((body1.Position - body2.Position).Length() <= 1.01)
        {
            return;
        }

        var (momentum, energy) = (world.Momentum(), world.Energy());
        world.Run((int)(2.5 / world.Settings.TimeStep));
        Near.Equal(momentum, world.Momentum(), Rounding * (m1 + m2));
        var change = body1.Velocity - u1;
        Assert.True(change.Length() > 0, "they missed each other");
        var normal = change.UnitVector();
        // Without friction only the speed along the line of centres changes: to −e of itself.
        Near.Equal(-e * Vector.Dot(u1 - u2, normal), Vector.Dot(body1.Velocity - body2.Velocity, normal), 1e-9);
        var loss = 0.5 * m1 * m2 / (m1 + m2) * (1 - (e * e)) * Math.Pow(Vector.Dot(u1 - u2, normal), 2);
        Near.Equal(energy - loss, world.Energy(), 1e-10 * energy);
    });

    [Fact]
    public void Oblique_AtSmallSteps_MeetsWhereTheSpheresMeet() => Seeded.Run(30, random =>
    {
        const double Step = 1e-4;
        var world = TestWorlds.Create(Vector.Zero, Step);
        var (velocity, lateralOffset) = (new Vector(random.Between(1, 4), 0, 0), random.Between(-0.8, 0.8));
        var body1 = world.Add(new(Vector.Zero, 0.5) { Velocity = velocity, Restitution = 1 });
        var body2 = world.Add(new(new(2, lateralOffset, 0), 0.5) { Velocity = -velocity, Restitution = 1 });
        world.Run((int)(1.5 / velocity.X / Step));
        var normal = new Vector(Math.Sqrt(1 - (lateralOffset * lateralOffset)), lateralOffset, 0);
        var expected = velocity - (2 * velocity.X * normal.X * normal);
        // Within a step one ball moves after the other, which turns the line of centres by the way of a step at most: 8·step over cos ≥
        // 0.6, times twice the speed.
        Near.Equal(expected, body1.Velocity, 8 * Step / 0.6 * 2 * 4);
        Near.Equal(-expected, body2.Velocity, 8 * Step / 0.6 * 2 * 4);
    });

    [Theory]
    [InlineData(0)]
    [InlineData(1e-3)]
    [InlineData(0.4)]
    public void ThreeInARow_OfOneMass_PassTheSpeedOn(double gap)
    {
        foreach (var step in new[] { 1e-3, 1 / 60.0, 0.1 })
        {
            var world = TestWorlds.Create(Vector.Zero, step);
            var bodies = new[] { 0, 2, 3 + gap, 4 + (2 * gap) }.Select(x => world.Add(new(new(x, 0, 0), 0.5) { Restitution = 1 }))
                .ToArray();
            world.SetVelocity(bodies[0], new(3, 0, 0));
            world.Run((int)(2 / step));
            Near.Equal(new(3, 0, 0), bodies[3].Velocity, Rounding);
            Assert.All(bodies[..3], body => Near.Equal(Vector.Zero, body.Velocity, Rounding));
        }
    }

    [Fact]
    public void ThreeInARow_OfAnyMasses_KeepMomentumAndEnergy() => Seeded.Run(100, random =>
    {
        var world = TestWorlds.Create(Vector.Zero, Math.Pow(10, random.Between(-3, -1)));
        var restitution = random.Next(2) == 0 ? 1 : random.NextDouble();
        for (var i = 0; i < 4; i++)
        {
            world.Add(
                new(new(1.2 * i, 0, 0), 0.5) { Mass = random.Between(0.1, 10), Restitution = restitution,
                Velocity = new(i == 0 ? 5 : random.Next(2) * -0.5, 0, 0) });
        }

        var (momentum, energy) = (world.Momentum(), world.Energy());
        world.Run((int)(3 / world.Settings.TimeStep));
        Near.Equal(momentum, world.Momentum(), 40 * Rounding);
        Assert.InRange(world.Energy(), 0, energy * (1 + 1e-10));
        if (restitution == 1)
        {
            Near.Equal(energy, world.Energy(), 1e-10 * energy);
        }
    });

    [Fact]
    public void Box_WithoutGravity_GoesToAndFroForEver() => CheckBox(2_000);

    [Fact]
    [Trait("Category", "Soak")]
    public void Box_WithoutGravityForLong_GoesToAndFroForEver() => CheckBox(100_000);

    [Fact]
    public void Box_WithGravity_KeepsTheEnergy() => CheckBoxWithGravity(2_000);

    [Fact]
    [Trait("Category", "Soak")]
    public void Box_WithGravityForLong_KeepsTheEnergy() => CheckBoxWithGravity(100_000);

    /// <summary>Axes don't meet in a box: each coordinate goes to and fro between two walls, as if there were no others.</summary>
    private static void CheckBox(int bounces) => Seeded.Run(3, random =>
    {
        var (radius, velocity, start, step) = (random.Between(0.02, 0.2), random.Vector(10) + new Vector(3, -1, 2), random.Vector(0.25),
            random.Between(0.01, 0.1));
        var world = TestWorlds.Create(Vector.Zero, step, TestWorlds.Place(PhysicsMeshes.InwardCube));
        var body = world.Add(new(start, radius) { Velocity = velocity, Restitution = 1 });
        var width = 1 - (2 * radius);
        var steps = (int)(bounces * width / step / (Math.Abs(velocity.X) + Math.Abs(velocity.Y) + Math.Abs(velocity.Z)));
        world.Run(steps, () =>
        {
            Near.Equal(velocity.Absolute(), body.Velocity.Absolute(), 1e-8);
            // Each bounce is found to 1e-10 of the radius.
            Near.Equal(new(Reflect(start.X, velocity.X), Reflect(start.Y, velocity.Y), Reflect(start.Z, velocity.Z)), body.Position,
                1e-9 + (1e-9 * radius * bounces));
        });

        double Reflect(double from, double speed)
        {
            var phase = (from + (world.Time * speed) + (width / 2)) / (2 * width);
            return (2 * width * Math.Abs(phase - Math.Floor(phase + 0.5))) - (width / 2);
        }
    });

    private static void CheckBoxWithGravity(int bounces) => Seeded.Run(3, random =>
    {
        var (radius, step) = (random.Between(0.02, 0.2), random.Between(0.002, 0.02));
        var world = TestWorlds.Create(TestWorlds.Gravity, step, TestWorlds.Place(PhysicsMeshes.InwardCube));
        // Fast enough to reach the ceiling with some speed left: what arrives more slowly than gravity works in half a step does not
        // bounce.
        var velocity = new Vector(random.Between(2, 4), random.Between(6, 8), random.Between(-4, -2));
        var body = world.Add(new(random.Vector(0.2), radius) { Velocity = velocity, Restitution = 1 });
        var energy = world.Energy();
        var steps = (int)(bounces * (1 - (2 * radius)) / step / (velocity.X + velocity.Y - velocity.Z));
        world.Run(steps, () =>
        {
            Assert.InRange(world.Energy(), energy * 0.999, energy * 1.001);
            Near.Equal(Math.Abs(velocity.X), Math.Abs(body.Velocity.X), 1e-8);
            Assert.True(body.Position.MaxAbsComponent() <= 0.5 - (radius * (1 - 1e-6)), $"outside at {body.Position}");
        });
    });
}
