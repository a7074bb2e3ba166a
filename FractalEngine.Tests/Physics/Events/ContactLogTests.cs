using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics;
using FractalEngine.Core.Physics.Bodies;
using FractalEngine.Core.Physics.Events;
using FractalEngine.Core.Physics.Statics;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Physics.Events;

/// <summary>Contacts of steps, and what is told of them: in the order of bodies, each pair once.</summary>
public sealed class ContactLogTests
{
    private readonly List<Body> _bodies = [.. Enumerable.Range(0, 4).Select(static i => new Body(new(new(i, 0, 0), 0.5), i))];
    private readonly PhysicsWorld _world = new();
    private readonly StaticObjectSet _statics = new(static _ => { }, null);
    private readonly ContactLog _log;

    public ContactLogTests()
    {
        _log = new(_bodies, _statics) { IsEnabled = true };
        for (var i = 0; i < 2; i++)
        {
            _statics.Add(_world.AddStatic(PhysicsMeshes.Cube));
        }
    }

    [Fact]
    public void Compare_OfTwoRecords_GoesByTheFirstBodyAndThenByTheSecond()
    {
        static ContactRecord Record(int first, int second) => new(first, second, Vector.I, Vector.J, first);
        ContactRecord[] ordered = [Record(0, -3), Record(0, -2), Record(0, -1), Record(0, 1), Record(0, 3), Record(1, -9), Record(2, 0)];
        for (var i = 0; i < ordered.Length; i++)
        {
            for (var j = 0; j < ordered.Length; j++)
            {
                Assert.Equal(Math.Sign(i - j), Math.Sign(ContactRecord.Compare(ordered[i], ordered[j])));
            }
        }

        Assert.Equal((-2, -3), (ContactRecord.OfObject(0), ContactRecord.OfObject(1)));
        Assert.Equal(5, ContactRecord.OfObject(ContactRecord.OfObject(5)));
    }

    [Fact]
    public void Add_OfAPairInEitherOrder_IsTheSamePair()
    {
        _log.Add(2, 1, Vector.I, Vector.J, 3);
        _log.Add(1, 2, Vector.I, -Vector.J, 4);
        _log.Add(0, ContactRecord.OfObject(1), Vector.K, Vector.K, 5);
        Assert.Equal(3, _log.Records.Length);
        Assert.Equal(new(1, 2, Vector.I, -Vector.J, 3), _log.Records[0]);
        Assert.Equal(new(1, 2, Vector.I, -Vector.J, 4), _log.Records[1]);
        Assert.Equal(new(0, -3, Vector.K, Vector.K, 5), _log.Records[2]);
        _log.Finish();
        Assert.Equal(
            [
                new(ContactPhase.Begin, _bodies[0], null, _statics.Objects[1], Vector.K, Vector.K, 5),
                new(ContactPhase.Begin, _bodies[1], _bodies[2], null, Vector.I, -Vector.J, 7),
            ],
            _log.Events);
        Assert.Equal(0, _log.Records.Length);
    }

    /// <summary>Where and how of the strongest of several contacts, and the sum of their impulses.</summary>
    [Fact]
    public void Finish_OfSeveralContactsOfAPair_TellsOfTheStrongest()
    {
        _log.Add(0, 1, Vector.I, Vector.J, 2);
        _log.Add(0, 1, Vector.J, Vector.K, 8);
        _log.Add(0, 1, Vector.K, Vector.I, 4);
        _log.Finish();
        Assert.Equal(new(ContactPhase.Begin, _bodies[0], _bodies[1], null, Vector.J, Vector.K, 14), Assert.Single(_log.Events));
    }

    [Fact]
    public void Finish_OfStepsThatFollow_TellsWhatBeginsStaysAndEnds()
    {
        _log.Add(0, 1, Vector.I, Vector.J, 1);
        _log.Add(1, 2, Vector.I, Vector.J, 2);
        _log.Add(2, 3, Vector.I, Vector.J, 3);
        _log.Finish();
        _log.Add(1, 2, Vector.K, Vector.J, 4);
        _log.Add(0, 3, Vector.K, Vector.J, 5);
        _log.Finish();
        Assert.Equal(
            [
                new(ContactPhase.End, _bodies[0], _bodies[1], null, Vector.I, Vector.J, 0),
                new(ContactPhase.Begin, _bodies[0], _bodies[3], null, Vector.K, Vector.J, 5),
                new(ContactPhase.Stay, _bodies[1], _bodies[2], null, Vector.K, Vector.J, 4),
                new(ContactPhase.End, _bodies[2], _bodies[3], null, Vector.I, Vector.J, 0),
            ],
            _log.Events);
        _log.Finish();
        Assert.Equal(
            [(ContactPhase.End, 0, 3, 0.0), (ContactPhase.End, 1, 2, 0.0)],
            _log.Events.Select(static one => (one.Phase, one.Body.Index, one.OtherBody!.Index, one.Impulse)));
        _log.Finish();
        Assert.Empty(_log.Events);
    }

    /// <summary>What sleeps still touches what it touched, unless that is awake.</summary>
    [Fact]
    public void Finish_OfBodiesThatSleep_KeepsTheirContacts()
    {
        _log.Add(0, 1, Vector.I, Vector.J, 1);
        _log.Add(0, 2, Vector.I, Vector.J, 2);
        _log.Add(1, ContactRecord.OfObject(0), Vector.I, Vector.J, 3);
        _log.Add(3, ContactRecord.OfObject(0), Vector.I, Vector.J, 4);
        _log.Finish();
        _bodies[0].Sleep();
        _bodies[1].Sleep();
        _log.Finish();
        Assert.Equal(
            [
                (ContactPhase.Stay, 0, 1, 0.0), (ContactPhase.End, 0, 2, 0.0), (ContactPhase.Stay, 1, -1, 0.0),
                (ContactPhase.End, 3, -1, 0.0),
            ],
            _log.Events.Select(static one => (one.Phase, one.Body.Index, one.OtherBody?.Index ?? -1, one.Impulse)));
    }

    [Fact]
    public void Finish_OfAContactWithWhatNobodyKnows_TellsNothingOfIt()
    {
        _log.Add(0, ContactRecord.Unknown, Vector.I, Vector.J, 1);
        _log.Add(0, ContactRecord.Unknown, Vector.I, Vector.J, 2);
        _log.Add(0, 1, Vector.I, Vector.J, 3);
        _log.Finish();
        Assert.Equal((_bodies[1], 3.0), (Assert.Single(_log.Events).OtherBody, _log.Events[0].Impulse));
    }

    [Fact]
    public void AddSum_OverSeveralContacts_SharesTheImpulseByTheirNormals()
    {
        var body = _bodies[0];
        foreach (var point in new[] { new Vector(0, -0.5, 0), new Vector(-0.5, 0, 0), new Vector(0, 0.5, 0) })
        {
            body.Contacts.Add(new Contact(point, 0.5, Vector.Zero, Contact.NoBody, IsFlat: true), Vector.Zero);
        }

        _log.AddSum(body, Vector.Zero, new(3, 4, 0));
        Assert.Equal(3, _log.Records.Length);
        Near.Equal(4, _log.Records[0].Impulse, 1e-15);
        Near.Equal(3, _log.Records[1].Impulse, 1e-15);
        Assert.Equal((0.0, new(0, 0.5, 0), -Vector.J), (_log.Records[2].Impulse, _log.Records[2].Point, _log.Records[2].Normal));
        Assert.Equal((0, ContactRecord.Unknown, new(0, -0.5, 0), Vector.J),
            (_log.Records[0].First, _log.Records[0].Second, _log.Records[0].Point, _log.Records[0].Normal));
        _log.AddSum(body, Vector.Zero, new(-3, 0, 1));
        Assert.All(Enumerable.Range(3, 3), i => Assert.Equal(0, _log.Records[i].Impulse));
    }

    /// <summary>The normal force of a slope, which leaves the acceleration along it.</summary>
    [Fact]
    public void AddRest_OfABodyOnASlope_IsWhatStopsItsFall()
    {
        var body = new Body(new(Vector.Zero, 0.5) { Mass = 2 }, 1);
        _log.AddRest(body, Vector.Zero, new(0, -8, 0), Vector.Zero, 0.25);
        Assert.Equal(0, _log.Records.Length);
        body.Contacts.Add(new Contact(new(-0.3, -0.4, 0), 0.5, Vector.Zero, 3, IsFlat: false), Vector.Zero);
        // All of the normal force: the acceleration along the slope stays.
        _log.AddRest(body, Vector.Zero, new(0, -8, 0), new(3.84, -2.88, 0), 0.25);
        Near.Equal(2 * 0.25 * 6.4, _log.Records[0].Impulse, 1e-14);
        Assert.Equal((1, 3), (_log.Records[0].First, _log.Records[0].Second));
        Near.Equal(new(0.6, 0.8, 0), _log.Records[0].Normal, 1e-15);
    }

    [Fact]
    public void Log_ThatIsOff_CollectsNothing()
    {
        var log = new ContactLog(_bodies, _statics);
        var body = _bodies[0];
        var contact = new Contact(new(0, -0.5, 0), 0.5, Vector.Zero, Contact.NoBody, IsFlat: true);
        body.Contacts.Add(in contact, Vector.Zero);
        log.Add(0, 1, Vector.I, Vector.J, 1);
        log.Add(body, in contact, Vector.Zero, 1);
        log.AddSum(body, Vector.Zero, Vector.J);
        log.AddRest(body, Vector.Zero, -Vector.J, Vector.Zero, 1);
        Assert.Equal(0, log.Records.Length);
        log.Reserve(1000);
        Assert.Equal(0, log.Events.Capacity);
        log.IsEnabled = true;
        log.Reserve(1000);
        Assert.InRange(log.Events.Capacity, 1000, 2000);
        log.Add(body, in contact, Vector.Zero, 1);
        Assert.Equal(1, log.Records.Length);
        log.Add(0, 1, Vector.I, Vector.J, 1);
        log.Finish();
        Assert.Single(log.Events);
        log.Add(0, 2, Vector.I, Vector.J, 1);
        log.Clear();
        Assert.Empty(log.Events);
        Assert.Equal(0, log.Records.Length);
        log.Finish();
        Assert.Empty(log.Events);
    }
}
