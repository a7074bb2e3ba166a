using System.Globalization;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Core.Physics.Events;
using FractalEngine.Core.Physics.Statics;
using FractalEngine.Core.Scenes;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Physics.Events;

/// <summary>What the world tells of contacts and triggers, with their impulses.</summary>
public class ContactEventTests
{
    private static readonly PhysicsSettings Reporting = new() { ReportsContacts = true };

    [Fact]
    public void Bounce_BeginsAndEndsWithItsImpulse()
    {
        var world = new PhysicsWorld(Reporting);
        var floor = world.AddStatic(PhysicsMeshes.Cube, Floor);
        var body = world.AddSphere(new(0.2, 2.5, 0.1), 0.5, restitution: 0.5, mass: 3);
        var events = Collect(world, 50);
        var begin = events[0];
        Assert.Equal((ContactPhase.Begin, body, floor), (begin.Phase, begin.Body, begin.StaticObject));
        Assert.Null(begin.OtherBody);
        // From 2 units above it arrives at √(2·g·h).
        Near.Equal(3 * 1.5 * Math.Sqrt(2 * 9.8 * 2), begin.Impulse, 1e-9);
        Near.Equal(new(0.2, 0, 0.1), begin.Point, 1e-6);
        Near.Equal(Vector.J, begin.Normal, 1e-9);
        Assert.Equal((ContactPhase.End, 0), (events[1].Phase, events[1].Impulse));
    }

    [Fact]
    public void Rest_StaysWithTheWeight_AndDuringSleep()
    {
        var world = new PhysicsWorld(Reporting);
        world.AddStatic(PhysicsMeshes.Cube, Floor);
        var body = world.AddSphere(new(0, 0.5, 0), 0.5, mass: 2);
        world.Run(2);
        var contact = Assert.Single(world.ContactEvents);
        Assert.Equal(ContactPhase.Stay, contact.Phase);
        Near.Equal(2 * 9.8 / 60, contact.Impulse, 1e-9);
        world.Run(60);
        Assert.True(body.IsAsleep);
        contact = Assert.Single(world.ContactEvents);
        Assert.Equal((ContactPhase.Stay, 0), (contact.Phase, contact.Impulse));
    }

    /// <summary>Friction holds it at once, and all of the step is rest.</summary>
    [Fact]
    public void Rest_OfABallThatDoesNotTurn_StaysWithTheWeight()
    {
        var world = new PhysicsWorld(Reporting);
        world.AddStatic(PhysicsMeshes.Cube, Floor);
        world.Add(new(new(0, 0.5, 0), 0.5) { Mass = 2, Friction = 0.5, IsRotationLocked = true });
        world.Run(2);
        Near.Equal(2 * 9.8 / 60, Assert.Single(world.ContactEvents).Impulse, 1e-9);
    }

    [Fact]
    public void Stack_TellsOfEachPairOnce()
    {
        var world = new PhysicsWorld(new PhysicsSettings { ReportsContacts = true, SleepSpeed = 0 });
        world.AddStatic(PhysicsMeshes.Cube, Floor);
        world.AddRange(Enumerable.Range(0, 3).Select(static i => new BodyDescription(new(0, i + 0.5, 0), 0.5)));
        world.Run(5);
        Assert.Equal(3, world.ContactEvents.Count);
        Assert.All(world.ContactEvents, static contact => Assert.Equal(ContactPhase.Stay, contact.Phase));
        // The lowest contact carries three balls, the highest one.
        var impulses = world.ContactEvents.Select(static contact => contact.Impulse).Order().ToArray();
        Assert.All(impulses.Index(), static load => Near.Equal((load.Index + 1) * 9.8 / 60, load.Item, 1e-9));
        var pair = world.ContactEvents.Single(contact => contact.OtherBody == world.Bodies[2]);
        Assert.Equal(world.Bodies[1], pair.Body);
        Near.Equal(new(0, -1, 0), pair.Normal, 1e-9);
    }

    [Fact]
    public void Corner_SharesTheImpulseByItsNormals()
    {
        var world = new PhysicsWorld(Reporting) { Gravity = new(-3, -4, 0) };
        world.AddStatic(PhysicsMeshes.Cube, Floor);
        var wall = world.AddStatic(PhysicsMeshes.Cube, new(new(-1, 5, 0), Vector.Zero, new(1, 20, 20)));
        world.AddSphere(new(0, 0.5, 0), 0.5);
        world.Run(5);
        Near.Equal(3 / 60.0, world.ContactEvents.Single(contact => contact.StaticObject == wall).Impulse, 1e-9);
        Near.Equal(4 / 60.0, world.ContactEvents.Single(contact => contact.StaticObject != wall).Impulse, 1e-9);
    }

    [Fact]
    public void Trigger_ReportsAndStopsNothing()
    {
        var world = new PhysicsWorld(Reporting);
        var trigger = world.AddStatic(PhysicsMeshes.Cube, new(new(0, 5, 0), Vector.Zero, new(2, 2, 2)));
        trigger.IsTrigger = true;
        var body = world.AddSphere(new(0, 8, 0), 0.25);
        var events = Collect(world, 90);
        Near.Equal(8 - (0.5 * 9.8 * 1.5 * 1.5), body.Position.Y, 1e-9);
        Assert.All(events, contact => Assert.Equal((body, trigger, 0), (contact.Body, contact.StaticObject, contact.Impulse)));
        Assert.Equal(ContactPhase.Begin, events[0].Phase);
        Assert.Equal(ContactPhase.End, events[^1].Phase);
        // From 8 − 0.25 to 6, and to 4 − 0.25 on.
        var inside = Math.Sqrt(2 * 4.25 / 9.8) - Math.Sqrt(2 * 1.75 / 9.8);
        Near.Equal(inside * 60, events.Count - 1, 1);
    }

    [Fact]
    public void Trigger_ThatIsInsideOut_HasWithinWhatIsWithin()
    {
        var world = new PhysicsWorld(Reporting);
        var trigger = world.AddStatic(PhysicsMeshes.Cube, new(new(0, 5, 0), Vector.Zero, new(-20, 20, 20)));
        trigger.IsTrigger = true;
        // The mirror turns its faces inwards. The ball is far from all of them.
        world.AddSphere(new(0.5, 5, 0), 0.25);
        Assert.Equal(ContactPhase.Begin, Assert.Single(Collect(world, 1)).Phase);
        world.AddSphere(new(15, 5, 0), 0.25);
        Assert.Equal(ContactPhase.Stay, Assert.Single(Collect(world, 1)).Phase);
    }

    /// <summary>A trigger wakes nobody: it comes to a body that sleeps, and goes on.</summary>
    [Fact]
    public void Trigger_ThatPassesASleepingBody_IsEnteredAndLeft()
    {
        var world = new PhysicsWorld(Reporting);
        var floor = world.AddStatic(PhysicsMeshes.Cube, Floor);
        var trigger = world.AddStatic(PhysicsMeshes.Cube, Samples.Move(-4, 0.5, 0));
        trigger.IsTrigger = true;
        var ball = world.AddSphere(new(0, 0.5, 0), 0.5);
        trigger.SetMotion(new(1.5, 0, 0));
        var events = new List<ContactEvent>();
        for (var step = 0; step < 400; step++)
        {
            world.Step();
            events.AddRange(world.ContactEvents.Where(one => one.StaticObject == trigger));
        }

        Assert.True(ball.IsAsleep);
        Assert.Equal((ContactPhase.Begin, ContactPhase.End), (events[0].Phase, events[^1].Phase));
        // Their surfaces meet from -1 to 1.
        Near.Equal(2 / 1.5 * 60, events.Count - 1, 1.01);
        Assert.Equal((ContactPhase.Stay, floor), (Assert.Single(world.ContactEvents).Phase, world.ContactEvents[0].StaticObject));
    }

    [Fact]
    public void Reset_WhileBodiesTouch_LetsTheirContactsBeginAgain()
    {
        var cube = new MeshModel(PhysicsMeshes.Cube);
        var ball = new PhysicsObject(cube, 0.5) { Placement = Samples.Move(0, 0.5, 0) };
        var world = new PhysicsWorld(new Scene { Objects = [new SceneObject(cube) { Placement = Floor }, ball] }, Reporting);
        var first = Collect(world, 3).Select(static contact => contact.Phase).ToArray();
        world.Reset();
        Assert.Equal(first, Collect(world, 3).Select(static contact => contact.Phase));
    }

    /// <summary>A plate goes so fast that, at the end of the step, it is no more where it has carried the ball.</summary>
    [Fact]
    public void Plate_ThatIsPulledAwayFromUnderABall_IsTouchedNoMore()
    {
        var world = new PhysicsWorld(Reporting);
        var plate = world.AddStatic(PhysicsMeshes.Cube, new(new(0, -0.5, 0), Vector.Zero, new(2, 1, 2)));
        var ball = world.AddSphere(new(0.5, 0.5, 0), 0.5);
        world.Run(3);
        Assert.Equal((ContactPhase.Stay, ball), (Assert.Single(world.ContactEvents).Phase, world.ContactEvents[0].Body));
        plate.SetMotion(new(-60, 0, 0));
        world.Step();
        Assert.Equal((ContactPhase.End, plate), (Assert.Single(world.ContactEvents).Phase, world.ContactEvents[0].StaticObject));
        world.Step();
        Assert.Empty(world.ContactEvents);
    }

    /// <summary>In the order of the bodies, then of what they touch; what ends stands where it has stood.</summary>
    [Fact]
    public void Events_OfManyBodies_AreInTheOrderOfTheirIndices()
    {
        var world = new PhysicsWorld(Reporting);
        world.AddStatic(PhysicsMeshes.Cube, Floor);
        var trigger = world.AddStatic(PhysicsMeshes.Cube, new(new(0, 0.5, 0), Vector.Zero, new(9, 1, 9)));
        trigger.IsTrigger = true;
        // Each lies on the floor and touches the next one.
        world.AddRange(Enumerable.Range(0, 4).Select(static i => new BodyDescription(new(i, 0.5, 0), 0.5)));
        string[] expected = ["0+1", "0+f", "0+t", "1+2", "1+f", "1+t", "2+3", "2+f", "2+t", "3+f", "3+t"];
        world.Step();
        Assert.Equal(expected.Order(), Texts(ContactPhase.Begin).Order());
        var order = Texts(ContactPhase.Begin).ToArray();
        Assert.Equal([0, 0, 0, 1, 1, 1, 2, 2, 2, 3, 3], world.ContactEvents.Select(static one => one.Body.Index));
        world.Step();
        Assert.Equal(order, Texts(ContactPhase.Stay));
        world.SetVelocity(world.Bodies[1], new(0, 90, 0));
        world.Step();
        Assert.Equal(order, Texts(null));
        // In a trigger is what is there at the end of the step; what touched at its beginning has done so in it.
        Assert.Equal(["1+t"], Texts(ContactPhase.End));
        Assert.Equal(order.Except(["1+t"]), Texts(ContactPhase.Stay));
        world.Step();
        Assert.Equal(["0+1", "1+2", "1+f"], Texts(ContactPhase.End).Order());
        Assert.Equal(order.Except(["0+1", "1+2", "1+f", "1+t"]), Texts(ContactPhase.Stay));

        IEnumerable<string> Texts(ContactPhase? phase) => world.ContactEvents.Where(one => phase is null || one.Phase == phase).Select(
            one => string.Create(
                CultureInfo.InvariantCulture, $"{one.Body.Index}+{one.OtherBody?.Index}{TextOf(one.StaticObject)}"));

        string TextOf(StaticObject? target) => target is null ? "" : target == trigger ? "t" : "f";
    }

    [Fact]
    public void Events_AreOffUnlessAskedFor()
    {
        var world = new PhysicsWorld();
        world.AddStatic(PhysicsMeshes.Cube, Floor);
        world.AddSphere(new(0, 0.5, 0), 0.5);
        world.Run(5);
        Assert.Empty(world.ContactEvents);
    }

    [Fact]
    public void Layers_LetOnlyThoseMeetWhoseMasksAgree()
    {
        var world = new PhysicsWorld();
        var floor = world.AddStatic(PhysicsMeshes.Cube, Floor);
        floor.Layer = 1;
        var ghost = world.Add(new(new(0, 0.6, 0), 0.5) { Mask = ~2u });
        var solid = world.Add(new(new(0, 2, 0), 0.5) { Layer = 2 });
        var second = world.Add(new(new(3, 0.5, 0), 0.5) { Layer = 3, Mask = ~8u });
        var third = world.Add(new(new(3, 1, 0), 0.5) { Layer = 3, Mask = ~8u });
        world.Run(120);
        Assert.True(ghost.Position.Y < -10, "the ghost has fallen through");
        Assert.All([solid, second, third], static body => Near.Equal(0.5, body.Position.Y, 1e-9));
        floor.Mask = 0;
        world.Run(60);
        Assert.True(solid.Position.Y < -4, "the floor meets nothing");
        Assert.Throws<ArgumentOutOfRangeException>(() => floor.Layer = 32);
        Assert.Throws<ArgumentException>(() => world.Add(new(Vector.Zero, 1) { Layer = -1 }));
    }

    private static Transformation Floor => new(new(0, -0.5, 0), Vector.Zero, new(20, 1, 20));

    private static List<ContactEvent> Collect(PhysicsWorld world, int steps)
    {
        var events = new List<ContactEvent>();
        world.Run(steps, () => events.AddRange(world.ContactEvents));
        return events;
    }
}
