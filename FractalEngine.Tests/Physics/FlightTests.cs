using FractalEngine.Core.Maths;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Physics;

/// <summary>Free flight and bounces against their formulas.</summary>
public class FlightTests
{
    // One rounding of a double for each of the additions that a step makes.
    private const double Rounding = 4 * 2.3e-16;

    public static TheoryData<double> Steps => [1e-5, 1e-4, 1e-3, 1 / 240.0, 1 / 60.0, 0.1];

    [Theory]
    [MemberData(nameof(Steps))]
    public void FreeFlight_AtAnyStep_IsTheParabola(double step) => Seeded.Run(5, random =>
    {
        var gravity = random.Vector(10);
        var start = random.Vector(3);
        var velocity = random.Vector(20);
        var world = TestWorlds.Create(gravity, step);
        var body = world.Add(new(start, 0.1) { Velocity = velocity });
        var steps = Math.Min(2000, (int)(20 / step));
        world.Run(steps, () =>
        {
            var time = world.StepCount * step;
            var expected = start + (time * velocity) + (0.5 * time * time * gravity);
            Near.Equal(expected, body.Position, Rounding * world.StepCount * (3 + (20 * time) + (10 * time * time)));
            Near.Equal(velocity + (time * gravity), body.Velocity, Rounding * world.StepCount * (20 + (10 * time)));
        });
        Assert.Equal(steps * step, world.Time, 1e-9);
    });

    [Fact]
    public void FreeFlight_PastSurfaces_IsTheParabola() => Seeded.Run(20, random =>
    {
        var world = TestWorlds.Create(
            TestWorlds.Gravity, random.Between(1e-3, 0.05), TestWorlds.Place(PhysicsMeshes.Cube, Samples.Move(0, -1e5, 0)),
            TestWorlds.Place(PhysicsMeshes.Cube, Samples.Move(-5, 0, 0)));
        var velocity = new Vector(random.Between(1, 20), random.Between(-5, 20), random.Between(-5, 5));
        var body = world.Add(new(Vector.Zero, 0.1) { Velocity = velocity });
        world.Run(200, () =>
        {
            var expected = (world.Time * velocity) + (0.5 * world.Time * world.Time * TestWorlds.Gravity);
            Near.Equal(expected, body.Position, Rounding * world.StepCount * 1000);
        });
    });

    [Theory]
    [MemberData(nameof(Steps))]
    public void Bounce_OnAFloor_RisesByTheSquareOfRestitution(double step) => Seeded.RunMost(step < 1e-4 ? 2 : 40, random =>
    {
        const double Gravity = 9.8;
        var restitution = random.Between(0.2, 1);
        var height = random.Between(0.1, 2);
        var radius = Math.Pow(10, random.Between(-2, 0));
        var world = TestWorlds.Create(TestWorlds.Gravity, step, TestWorlds.Place(PhysicsMeshes.FloorMesh()));
        var body = world.Add(new(new(0.3, radius + height, -0.2), radius) { Restitution = restitution });
        var expectedTop = height;
        var lastImpact = 0.0;
        // Until a flight takes less than two steps.
        for (var steps = 1; steps * step < 2 && Math.Sqrt(8 * expectedTop * restitution * restitution / Gravity) > 2 * step; steps++)
        {
            world.Step();
            // First a fall, then flights up and down.
            var nextImpact = lastImpact + (Math.Sqrt(2 * expectedTop / Gravity) * (lastImpact == 0 ? 1 : 2));
            if (steps * step > nextImpact)
            {
                lastImpact = nextImpact;
                expectedTop *= restitution * restitution;
            }

            // Speed and height give the top, wherever in the flight the step ends. Impacts are found to 1e-10 of the radius.
            var top = body.Position.Y - radius + (body.Velocity.Y * body.Velocity.Y / (2 * Gravity));
            Near.Equal(expectedTop, top, 1e-6 * height);
        }

        // At the longest step, flights after low falls take less than two steps from the beginning.
        return lastImpact > 0;
    }, minShare: 0.8);

    [Fact]
    public void Bounce_AtAnAngle_KeepsTheSpeedAlongTheSurface() => Seeded.Run(200, random =>
    {
        var normal = random.Direction();
        var restitution = random.NextDouble();
        var radius = random.Between(0.01, 0.5);
        var plane = PhysicsMeshes.FromTriangles(PhysicsMeshes.PlaneTriangle(Vector.Zero, normal));
        var world = TestWorlds.Create(Vector.Zero, random.Between(0.001, 0.1), TestWorlds.Place(plane));
        var velocity = random.Vector(10);
        velocity -= (Vector.Dot(velocity, normal) + random.Between(1, 10)) * normal;
        var body = world.AddSphere((radius + 0.5) * normal, radius, restitution, velocity);
        world.Run((int)(0.5 / world.Settings.TimeStep) + 2);
        // At 10 units per second, with an impact found to 1e-10 of the radius.
        Near.Equal(velocity - ((1 + restitution) * Vector.Dot(velocity, normal) * normal), body.Velocity, 1e-8);
    });
}
