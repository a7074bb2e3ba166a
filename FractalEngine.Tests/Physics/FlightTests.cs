using FractalEngine.Core.Maths;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Physics;

/// <summary>Flight and bounce against the formulas of school physics.</summary>
public class FlightTests
{
    // A double's last place, for each of the additions that a step makes.
    private const double Rounding = 4 * 2.3e-16;

    public static TheoryData<double> Steps => [1e-5, 1e-4, 1e-3, 1 / 240.0, 1 / 60.0, 0.1];

    [Theory]
    [MemberData(nameof(Steps))]
    public void FreeFlight_AtAnyStep_IsTheParabola(double step) => Seeded.Run(5, random =>
    {
        var (gravity, start, velocity) = (random.Vector(10), random.Vector(3), random.Vector(20));
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
        var world =
            TestWorlds.Create(TestWorlds.Gravity, random.Between(1e-3, 0.05),
            TestWorlds.Place(PhysicsMeshes.Cube, Samples.Move(0, -1e5, 0)),
            TestWorlds.Place(PhysicsMeshes.Cube, Samples.Move(-5, 0, 0)));
        var velocity = new Vector(random.Between(1, 20), random.Between(-5, 20), random.Between(-5, 5));
        var body = world.Add(new(Vector.Zero, 0.1) { Velocity = velocity });
        world.Run(200,
            () => Near.Equal((world.Time * velocity) + (0.5 * world.Time * world.Time * TestWorlds.Gravity), body.Position,
            Rounding * world.StepCount * 1000));
    });

    [Theory]
    [MemberData(nameof(Steps))]
    public void Bounce_OnAFloor_RisesByTheSquareOfRestitution(double step) => Seeded.Run(step < 1e-4 ? 4 : 40, random =>
    {
        var (restitution, height, radius) = (random.Between(0.2, 1), random.Between(0.1, 2), Math.Pow(10, random.Between(-2, 0)));
        var world = TestWorlds.Create(TestWorlds.Gravity, step, TestWorlds.Place(PhysicsMeshes.FloorMesh()));
        var body = world.Add(new(new(0.3, radius + height, -0.2), radius) { Restitution = restitution });
        var (rises, gravity) = (height, 9.8);
        for (var (steps, fallen) = (0, 0.0); steps * step < 2 && Math.Sqrt(8 * rises * restitution * restitution / gravity) > 2 * step;
            steps++)
        {
            world.Step();
            // Seconds until the ball comes down again: fall, then flights up and down.
            var time = (steps + 1) * step;
            var contact = fallen + Math.Sqrt(2 * rises / gravity) * (fallen == 0 ? 1 : 2);
            if (time > contact)
            {
                (fallen, rises) = (contact, rises * restitution * restitution);
            }

            // From speed and height the top follows, wherever in the flight the step ends. Impacts are found to 1e-10 of the radius, and
            // the promise is 1 %.
            var top = body.Position.Y - radius + (body.Velocity.Y * body.Velocity.Y / (2 * gravity));
            Near.Equal(rises, top, 1e-6 * height);
        }
    });

    [Fact]
    public void Bounce_AtAnAngle_KeepsTheSpeedAlongTheSurface() => Seeded.Run(200, random =>
    {
        var normal = random.Direction();
        var (restitution, radius) = (random.NextDouble(), random.Between(0.01, 0.5));
        var world =
            TestWorlds.Create(Vector.Zero, random.Between(0.001, 0.1),
            TestWorlds.Place(PhysicsMeshes.FromTriangles(PhysicsMeshes.PlaneTriangle(Vector.Zero, normal))));
        var velocity = random.Vector(10);
        velocity -= (Vector.Dot(velocity, normal) + random.Between(1, 10)) * normal;
        var body = world.Add(new((radius + 0.5) * normal, radius) { Velocity = velocity, Restitution = restitution });
        world.Run((int)(0.5 / world.Settings.TimeStep) + 2);
        // 10 m/s, 1e-10 of the radius in the direction of the normal.
        Near.Equal(velocity - ((1 + restitution) * Vector.Dot(velocity, normal) * normal), body.Velocity, 1e-8);
    });
}
