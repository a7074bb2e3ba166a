using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Core.Physics.Events;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Physics;

/// <summary>Compounds among what moves by itself, in triggers, and before rays and cast spheres.</summary>
public class CompoundWorldTests
{
    private const double Radius = 0.25;

    [Theory]
    [InlineData(5)]
    [InlineData(200)]
    [InlineData(10_000)]
    public void Plate_ThatHitsACompound_PassesNoBall(double speed)
    {
        var world = new PhysicsWorld { Gravity = Vector.Zero };
        // So wide that friction does not lead the compound round it.
        var plate = world.AddStatic(PhysicsMeshes.Cube, new(new(-3.3, 0.1, 0.2), Vector.Zero, new(0.05, 1e5, 1e5)));
        // The plate meets one ball first, which turns the other one towards it.
        var body = world.Add(new(Vector.Zero, Dumbbell(new(0.6, 0.8, 0))) { Restitution = 0.5, Friction = 0.3 });
        plate.SetMotion(new(speed, 0, 0));
        world.Run(60, () =>
        {
            var face = plate.Placement.Position.X + 0.025;
            for (var ball = 0; ball < body.BallCount; ball++)
            {
                var gap = body.BallCentre(ball).X - body.BallRadius(ball) - face;
                // Relative to the radius, and to the digits of a place so far from the origin.
                Assert.True(gap > (-1e-6 * Radius) - (1e-13 * face), $"ball {ball} overlaps by {-gap:R} after {world.StepCount} steps");
            }
        });
        Assert.True(body.Velocity.X > speed, $"{body.Velocity}");
        Assert.NotEqual(0, body.AngularVelocity.Z);
    }

    [Fact]
    public void SpinningDumbbells_PassNoPlate() => Seeded.Run(20, random =>
    {
        var world = new PhysicsWorld { Gravity = Vector.Zero };
        var shape = Dumbbell(random.Between(0.5, 2.5) * Vector.I);
        _ = world.AddStatic(PhysicsMeshes.Cube, new(new(3.2, 0, 0), Vector.Zero, new(0.001, 100, 100)));
        var body = world.Add(new(random.Between(-1, 0) * Vector.I, shape)
        {
            // Up to 1,600 turns a second, while it comes at up to 30 units a second.
            Velocity = Math.Pow(10, random.Between(-1, 1.5)) * Vector.I,
            AngularVelocity = Math.Pow(10, random.Between(0, 4)) * random.Vector().UnitVector(),
            Restitution = random.NextDouble(),
        });
        world.Run(30, () =>
        {
            for (var ball = 0; ball < body.BallCount; ball++)
            {
                var gap = 3.1995 - body.BallCentre(ball).X - body.BallRadius(ball);
                Assert.True(gap > -1e-6 * Radius, $"ball {ball} overlaps by {-gap:R} after {world.StepCount} steps");
            }

            Assert.True(world.LastStepCost.BoundTests + world.LastStepCost.FaceTests < 50_000, $"{world.LastStepCost}");
        });
    });

    [Theory]
    [InlineData(0.5)]
    [InlineData(2)]
    public void Turntable_WithACapsuleAcrossItsAxis_TurnsItAlong(double angularSpeed)
    {
        var world = new PhysicsWorld();
        var turntable = world.AddStatic(PhysicsMeshes.Cube, new(new(0, -0.5, 0), Vector.Zero, new(40, 1, 40)));
        var capsule = CompoundShape.Capsule(-1 * Vector.I, Vector.I, 0.4);
        var body = world.Add(new(new(0, 0.4, 0), capsule) { Friction = 0.8, RollingFriction = 0.05 });
        turntable.SetMotion(Vector.Zero, new(0, angularSpeed, 0));
        world.Run(300);
        Near.Equal(new(0, angularSpeed, 0), body.AngularVelocity, 1e-3 * angularSpeed);
        Near.Equal(new(0, 0.4, 0), body.Position, 1e-3);
    }

    [Fact]
    public void Trigger_ReportsACompound_ThatOneBallReachesIntoIt()
    {
        var world = new PhysicsWorld(new PhysicsSettings { ReportsContacts = true });
        // The centre of mass falls beside it.
        var trigger = world.AddStatic(PhysicsMeshes.Cube, new(new(1, 5, 0), Vector.Zero, new(1, 2, 1)));
        trigger.IsTrigger = true;
        var body = world.Add(new(new(0, 8, 0), Dumbbell(Vector.I)));
        var events = new List<ContactEvent>();
        world.Run(90, () => events.AddRange(world.ContactEvents));
        Near.Equal(8 - (0.5 * 9.8 * 1.5 * 1.5), body.Position.Y, 1e-9);
        Assert.All(events, contact => Assert.Equal((body, trigger), (contact.Body, contact.StaticObject)));
        Assert.Equal((ContactPhase.Begin, ContactPhase.End), (events[0].Phase, events[^1].Phase));
        // From 8 − 0.25 to 6, and to 4 − 0.25 on.
        var inside = Math.Sqrt(2 * 4.25 / 9.8) - Math.Sqrt(2 * 1.75 / 9.8);
        Near.Equal(inside * 60, events.Count - 1, 1);
    }

    [Fact]
    public void Casts_MeetTheBallsOfACompound_AndPassBetweenThem()
    {
        var world = new PhysicsWorld { Gravity = Vector.Zero };
        var body = world.Add(new(Vector.Zero, Dumbbell(Vector.I)));
        Assert.True(world.TryCastRay(new(new(1, 10, 0), -Vector.J), out var hit));
        Assert.Equal(body, hit.Body);
        Near.Equal(10 - Radius, hit.Distance, 1e-12);
        Near.Equal(Vector.J, hit.Normal, 1e-12);
        Assert.False(world.TryCastRay(new(new(0, 10, 0), -Vector.J), out _));
        Assert.True(world.TryCastSphere(new(-1.1, 10, 0), 0.5, new(0, -20, 0), out hit));
        Assert.Equal(body, hit.Body);
        // The centres are 0.75 apart where they touch.
        Near.Equal(10 - Math.Sqrt((0.75 * 0.75) - 0.01), hit.Distance, 1e-9);
        Assert.False(world.TryCastSphere(new(0, 10, 0), 0.5, new(0, -20, 0), out _));
    }

    private static CompoundShape Dumbbell(Vector arm) =>
        CompoundShape.OfBalls([new(-1 * arm, Radius), new(arm, Radius)]);
}
