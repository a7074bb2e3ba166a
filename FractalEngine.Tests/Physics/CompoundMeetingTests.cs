using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics;
using FractalEngine.Core.Physics.Compounds;
using FractalEngine.Core.Physics.Events;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Physics;

/// <summary>Bodies of several balls and what is not a body: objects that move, triggers, and what is cast.</summary>
public class CompoundMeetingTests
{
    private static readonly CompoundShape Dumbbell = CompoundShape.OfBalls([new(-1 * Vector.I, 0.5), new(Vector.I, 0.5)]);

    [Theory]
    [InlineData(1, 1)]
    [InlineData(20, 0.5)]
    [InlineData(200, 0)]
    [InlineData(200, 1)]
    public void Plate_ThatHitsCompounds_PassesNone(double speed, double restitution) => Seeded.Run(3, random =>
    {
        var world = new PhysicsWorld { Gravity = Vector.Zero };
        var plate = world.AddStatic(PhysicsMeshes.Cube, new(new(-1.6, 0, 0), Vector.Zero, new(0.05, 60, 60)));
        var capsule = CompoundShape.Capsule(-1 * Vector.J, Vector.J, 0.3);
        world.AddRange(Enumerable.Range(0, 6).Select(i => new BodyDescription(new(0, 8 * (i - 2.5), 0), i % 2 == 0 ? Dumbbell : capsule)
        {
            AngularVelocity = random.Vector(5), Restitution = restitution, Friction = 0.3,
        }));
        plate.SetMotion(new(speed, 0, 0));
        world.Run(120, () => Assert.All(world.Bodies, body => Assert.All(Enumerable.Range(0, body.BallCount), ball =>
        {
            var lead = body.BallCentre(ball).X - plate.Placement.Position.X - 0.025 - body.BallRadius(ball);
            Assert.True(lead > -1e-6, $"{body.Name} overlaps by {-lead:R} after {world.StepCount} steps");
        })));
        // The plate has met them all, and at least gives the centre of mass its share of the impulse.
        Assert.All(world.Bodies, body => Assert.True(body.Velocity.X > 0.1 * speed, $"{body.Name}: {body.Velocity}"));
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
    public void Trigger_ThatOneBallOfADumbbellCrosses_ReportsTheBody()
    {
        var world = new PhysicsWorld(new PhysicsSettings { ReportsContacts = true });
        var trigger = world.AddStatic(PhysicsMeshes.Cube, new(new(1, 5, 0), Vector.Zero, new(0.5, 2, 0.5)));
        trigger.IsTrigger = true;
        var beside = world.AddStatic(PhysicsMeshes.Cube, new(new(0, 5, 0), Vector.Zero, new(0.5, 2, 0.5)));
        beside.IsTrigger = true;
        var body = world.Add(new(new(0, 8, 0), Dumbbell));
        var events = new List<ContactEvent>();
        world.Run(90, () => events.AddRange(world.ContactEvents));
        Assert.All(events, contact => Assert.Equal((body, trigger, 0), (contact.Body, contact.StaticObject, contact.Impulse)));
        Assert.Equal((ContactPhase.Begin, ContactPhase.End), (events[0].Phase, events[^1].Phase));
        // The ball falls from 8 − 0.5 to 6, and on to 4 − 0.5; the handle between both balls is no part of the body.
        var inside = Math.Sqrt(2 * 4.5 / 9.8) - Math.Sqrt(2 * 1.5 / 9.8);
        Near.Equal(inside * 60, events.Count - 1, 1);
    }

    [Fact]
    public void Casts_MeetTheBallsOfATurnedDumbbell()
    {
        // A quarter turn about k leads its balls from ±i to ±j.
        var world = new PhysicsWorld { Gravity = Vector.Zero };
        var body = world.Add(new(new(0, 2, 0), Dumbbell) { AngularVelocity = new(0, 0, Math.PI / 2) });
        world.Run(60);
        Near.Equal(new(0, 1, 0), body.BallCentre(0), 1e-6);
        Assert.True(world.TryCastRay(new(new(-5, 3, 0), Vector.I), out var hit));
        Assert.Equal((body, null), (hit.Body, hit.StaticObject));
        Near.Equal(4.5, hit.Distance, 1e-6);
        Near.Equal(-Vector.I, hit.Normal, 1e-6);
        Assert.False(world.TryCastRay(new(new(-5, 2, 0), Vector.I), out _), "between the balls");
        Assert.True(world.TryCastRay(new(new(0, 8, 0), -Vector.J), out hit));
        Near.Equal(4.5, hit.Distance, 1e-6);
        Assert.True(world.TryCastSphere(new(-5, 1, 0), 0.25, new(20, 0, 0), out hit));
        Assert.Equal((body, null), (hit.Body, hit.StaticObject));
        Near.Equal(5 - 0.75, hit.Distance, 1e-6);
        Assert.False(world.TryCastSphere(new(-5, 2, 0), 0.25, new(20, 0, 0), out _), "between the balls");
        Assert.True(world.TryCastSphere(new(-5, 2, 0), 0.6, new(20, 0, 0), out hit));
        // It touches both balls at once, whose centres are 1 above and below its own.
        Near.Equal(5 - Math.Sqrt((1.1 * 1.1) - 1), hit.Distance, 1e-6);
    }
}
