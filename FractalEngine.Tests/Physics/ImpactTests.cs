using FractalEngine.Core.Maths;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Physics;

/// <summary>Impacts of two or more spheres: formulas along a line, and conservation laws for all others.</summary>
public class ImpactTests
{
    // The rounding of sums and products of a few numbers about 10.
    private const double Rounding = 1e-11;

    [Fact]
    public void HeadOn_WithAnyMasses_SeparatesAsTheFormulaSays() => CheckHeadOn(100);

    [Fact]
    [Trait("Category", "Soak")]
    public void HeadOn_WithManyMasses_SeparatesAsTheFormulaSays() => CheckHeadOn(3000);

    private static void CheckHeadOn(int count) => Seeded.Run(count, random =>
    {
        var m1 = Math.Pow(10, random.Between(-2, 2));
        var m2 = Math.Pow(10, random.Between(-2, 2));
        var e1 = random.NextDouble();
        var e2 = random.Next(3) == 0 ? 1 : random.NextDouble();
        var v1 = random.Between(1, 10);
        var v2 = random.Between(-10, 0.5);
        var direction = random.Direction();
        var world = TestWorlds.Create(Vector.Zero, Math.Pow(10, random.Between(-3, -1)));
        var body1 = world.AddSphere(Vector.Zero, random.Between(0.1, 1), e1, v1 * direction, m1);
        var body2 = world.AddSphere(3 * direction, random.Between(0.1, 1), e2, v2 * direction, m2);
        // The smaller restitution counts.
        var e = Math.Min(e1, e2);
        var common = ((m1 * v1) + (m2 * v2)) / (m1 + m2);
        world.Run((int)(8 / world.Settings.TimeStep));
        Near.Equal((common - (m2 * e * (v1 - v2) / (m1 + m2))) * direction, body1.Velocity, 1e-9);
        Near.Equal((common + (m1 * e * (v1 - v2) / (m1 + m2))) * direction, body2.Velocity, 1e-9);
    });

    [Fact]
    public void Oblique_WithAnyMasses_KeepsMomentumAndReversesTheApproach() => Seeded.RunMost(300, random =>
    {
        var m1 = random.Between(0.1, 10);
        var m2 = random.Between(0.1, 10);
        var e = random.Next(3) == 0 ? 1 : random.NextDouble();
        var world = TestWorlds.Create(Vector.Zero, Math.Pow(10, random.Between(-3, -1)));
        var target = random.Vector(3);
        var u1 = random.Vector(10);
        var u2 = random.Vector(10);
        // Both aim at one target, at most 0.8 apart there: spheres of radius 0.5 meet.
        var body1 = world.AddSphere(target - u1, 0.5, e, u1, m1);
        var body2 = world.AddSphere(target - u2 + (0.8 * random.NextDouble() * random.Direction()), 0.5, e, u2, m2);
        if ((body1.Position - body2.Position).Length() <= 1.01)
        {
            return false;
        }

        var momentum = world.Momentum();
        var energy = world.Energy();
        world.Run((int)(2.5 / world.Settings.TimeStep));
        Near.Equal(momentum, world.Momentum(), Rounding * (m1 + m2));
        var change = body1.Velocity - u1;
        Assert.True(change.Length() > 0, "they missed each other");
        var normal = change.UnitVector();
        // Without friction only the speed along the line of centres changes, to −e times its value.
        Near.Equal(-e * Vector.Dot(u1 - u2, normal), Vector.Dot(body1.Velocity - body2.Velocity, normal), 1e-9);
        var loss = 0.5 * m1 * m2 / (m1 + m2) * (1 - (e * e)) * Math.Pow(Vector.Dot(u1 - u2, normal), 2);
        Near.Equal(energy - loss, world.Energy(), 1e-10 * energy);
        return true;
    });

    [Fact]
    public void Oblique_AtSmallSteps_MeetsWhereTheSpheresMeet() => Seeded.Run(30, random =>
    {
        const double Step = 1e-4;
        var world = TestWorlds.Create(Vector.Zero, Step);
        var velocity = new Vector(random.Between(1, 4), 0, 0);
        var lateralOffset = random.Between(-0.8, 0.8);
        var body1 = world.AddSphere(Vector.Zero, 0.5, 1, velocity);
        var body2 = world.AddSphere(new(2, lateralOffset, 0), 0.5, 1, -velocity);
        world.Run((int)(1.5 / velocity.X / Step));
        var normal = new Vector(Math.Sqrt(1 - (lateralOffset * lateralOffset)), lateralOffset, 0);
        var expected = velocity - (2 * velocity.X * normal.X * normal);
        // Within a step one sphere moves after the other. That turns the line of centres by the distance of a step at most: by 8·step,
        // divided by a cosine of at least 0.6. The velocity changes by twice the speed times that angle.
        const double Tolerance = 8 * Step / 0.6 * 2 * 4;
        Near.Equal(expected, body1.Velocity, Tolerance);
        Near.Equal(-expected, body2.Velocity, Tolerance);
    });

    [Theory]
    [InlineData(0)]
    [InlineData(1e-3)]
    [InlineData(0.4)]
    public void FourInARow_OfOneMass_PassTheSpeedOn(double gap)
    {
        foreach (var step in new[] { 1e-3, 1 / 60.0, 0.1 })
        {
            var world = TestWorlds.Create(Vector.Zero, step);
            var bodies = new[] { 0, 2, 3 + gap, 4 + (2 * gap) }.Select(x => world.AddSphere(new(x, 0, 0), 0.5, 1)).ToArray();
            world.SetVelocity(bodies[0], new(3, 0, 0));
            world.Run((int)(2 / step));
            Near.Equal(new(3, 0, 0), bodies[3].Velocity, Rounding);
            Assert.All(bodies[..3], body => Near.Equal(Vector.Zero, body.Velocity, Rounding));
        }
    }

    [Fact]
    public void FourInARow_OfAnyMasses_KeepMomentumAndEnergy() => Seeded.Run(100, random =>
    {
        var world = TestWorlds.Create(Vector.Zero, Math.Pow(10, random.Between(-3, -1)));
        var restitution = random.Next(2) == 0 ? 1 : random.NextDouble();
        for (var i = 0; i < 4; i++)
        {
            var mass = random.Between(0.1, 10);
            var velocity = new Vector(i == 0 ? 5 : random.Next(2) * -0.5, 0, 0);
            world.AddSphere(new(1.2 * i, 0, 0), 0.5, restitution, velocity, mass);
        }

        var momentum = world.Momentum();
        var energy = world.Energy();
        world.Run((int)(3 / world.Settings.TimeStep));
        Near.Equal(momentum, world.Momentum(), 40 * Rounding);
        Assert.InRange(world.Energy(), 0, energy * (1 + 1e-10));
        if (restitution == 1)
        {
            Near.Equal(energy, world.Energy(), 1e-10 * energy);
        }
    });

    [Fact]
    public void Box_WithoutGravity_ReflectsForEver() => CheckBox(2_000);

    [Fact]
    [Trait("Category", "Soak")]
    public void Box_WithoutGravityForLong_ReflectsForEver() => CheckBox(100_000);

    [Fact]
    public void Box_WithGravity_KeepsTheEnergy() => CheckBoxWithGravity(2_000);

    [Fact]
    [Trait("Category", "Soak")]
    public void Box_WithGravityForLong_KeepsTheEnergy() => CheckBoxWithGravity(100_000);

    /// <summary>In a box the axes are independent: each coordinate is reflected between two walls, as if there were no others.</summary>
    private static void CheckBox(int bounces) => Seeded.Run(3, random =>
    {
        var radius = random.Between(0.02, 0.2);
        var velocity = random.Vector(10) + new Vector(3, -1, 2);
        var start = random.Vector(0.25);
        var step = random.Between(0.01, 0.1);
        var world = TestWorlds.Create(Vector.Zero, step, TestWorlds.Place(PhysicsMeshes.InwardCube));
        var body = world.AddSphere(start, radius, 1, velocity);
        var width = 1 - (2 * radius);
        var steps = (int)(bounces * width / step / (Math.Abs(velocity.X) + Math.Abs(velocity.Y) + Math.Abs(velocity.Z)));
        world.Run(steps, () =>
        {
            Near.Equal(velocity.Absolute(), body.Velocity.Absolute(), 1e-8);
            // Each bounce is found to 1e-10 of the radius.
            var expected = new Vector(Reflect(start.X, velocity.X), Reflect(start.Y, velocity.Y), Reflect(start.Z, velocity.Z));
            Near.Equal(expected, body.Position, 1e-9 + (1e-9 * radius * bounces));
        });

        double Reflect(double from, double speed)
        {
            var phase = (from + (world.Time * speed) + (width / 2)) / (2 * width);
            return (2 * width * Math.Abs(phase - Math.Floor(phase + 0.5))) - (width / 2);
        }
    });

    private static void CheckBoxWithGravity(int bounces) => Seeded.Run(3, random =>
    {
        var radius = random.Between(0.02, 0.2);
        var step = random.Between(0.002, 0.02);
        var world = TestWorlds.Create(TestWorlds.Gravity, step, TestWorlds.Place(PhysicsMeshes.InwardCube));
        // Fast enough to reach the ceiling with some speed left: slower than half of what gravity adds in a step, it would not bounce.
        var velocity = new Vector(random.Between(2, 4), random.Between(6, 8), random.Between(-4, -2));
        var body = world.AddSphere(random.Vector(0.2), radius, 1, velocity);
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
