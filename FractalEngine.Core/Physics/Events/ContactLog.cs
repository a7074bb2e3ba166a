using System.Runtime.InteropServices;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Bodies;
using FractalEngine.Core.Physics.Statics;

namespace FractalEngine.Core.Physics.Events;

/// <summary>Collects the contacts of a step with their impulses, and tells which have begun, stayed and ended.</summary>
internal sealed class ContactLog(List<Body> bodies, StaticObjectSet statics)
{
    // Bounces, impulses and forces of a contact are added one by one.
    private const int RecordsPerContact = 4;

    private List<ContactRecord> _records = [];
    private List<ContactRecord> _previous = [];

    /// <summary>Whether contacts are collected at all.</summary>
    public bool IsEnabled { get; set; }

    /// <summary>What has happened in the last step, in the order of the bodies.</summary>
    public List<ContactEvent> Events { get; } = [];

    /// <summary>The contacts that have been collected in this step, which may be replaced while it is not finished.</summary>
    public Span<ContactRecord> Records => CollectionsMarshal.AsSpan(_records);

    /// <summary>Makes room for the contacts of a step.</summary>
    public void Reserve(int contactCount)
    {
        if (IsEnabled)
        {
            _records.EnsureCapacity(RecordsPerContact * contactCount);
            _previous.EnsureCapacity(RecordsPerContact * contactCount);
            Events.EnsureCapacity(contactCount);
        }
    }

    /// <summary>Forgets the contacts of all steps so far.</summary>
    public void Clear()
    {
        _records.Clear();
        _previous.Clear();
        Events.Clear();
    }

    /// <summary>Adds a contact of two bodies, or of a body with a surface.</summary>
    /// <param name="first">Index of the body on the normal's side.</param>
    /// <param name="second">Index of the other one; negative for a surface.</param>
    /// <param name="point">World space.</param>
    /// <param name="normal">Unit vector towards the first body.</param>
    /// <param name="impulse">Along the normal.</param>
    public void Add(int first, int second, Vector point, Vector normal, double impulse)
    {
        if (IsEnabled)
        {
            _records.Add(second >= 0 && second < first
                ? new(second, first, point, -normal, impulse)
                : new(first, second, point, normal, impulse));
        }
    }

    /// <summary>Shares what all contacts of a body have done to it among them.</summary>
    /// <param name="body">Its contacts are those that acted.</param>
    /// <param name="position">Position of the body, world space.</param>
    /// <param name="impulse">The sum of the impulses.</param>
    public void AddSum(Body body, Vector position, Vector impulse)
    {
        if (!IsEnabled)
        {
            return;
        }

        // Exact for one contact and for normals at right angles.
        var sum = 0.0;
        for (var i = 0; i < body.Contacts.Count; i++)
        {
            var share = Math.Max(0, Vector.Dot(impulse, body.Contacts[i].Normal(position)));
            sum += share * share;
        }

        for (var i = 0; i < body.Contacts.Count; i++)
        {
            var contact = body.Contacts[i];
            var normal = contact.Normal(position);
            var share = Math.Max(0, Vector.Dot(impulse, normal));
            Add(body, in contact, position, sum > 0 ? share * impulse.LengthSquared() / sum : 0);
        }
    }

    /// <summary>Adds what contacts have done against an acceleration that leads into them.</summary>
    /// <param name="body">Its contacts are those that acted.</param>
    /// <param name="position">Position of the body, world space.</param>
    /// <param name="acceleration">By gravity and forces.</param>
    /// <param name="netAcceleration">What the contacts leave of it.</param>
    /// <param name="duration">Seconds.</param>
    public void AddRest(Body body, Vector position, Vector acceleration, Vector netAcceleration, double duration)
    {
        if (IsEnabled && body.Contacts.Count > 0)
        {
            AddSum(body, position, body.Description.Mass * duration * (netAcceleration - acceleration));
        }
    }

    /// <summary>Adds a contact of a body that moves alone.</summary>
    public void Add(Body body, in Contact contact, Vector position, double impulse)
    {
        if (IsEnabled)
        {
            var normal = contact.Normal(position);
            Add(body.Index, contact.BodyIndex, position - (body.Radius * normal), normal, impulse);
        }
    }

    /// <summary>Ends the step: records of the same two are joined, and compared with those of the step before.</summary>
    public void Finish()
    {
        Events.Clear();
        KeepSleepers();
        _records.Sort(ContactRecord.Compare);
        Join();
        var old = 0;
        foreach (var record in _records)
        {
            while (old < _previous.Count && ContactRecord.Compare(_previous[old], record) < 0)
            {
                AddEvent(ContactPhase.End, _previous[old++] with { Impulse = 0 });
            }

            var hasStayed = old < _previous.Count && ContactRecord.Compare(_previous[old], record) == 0;
            old += hasStayed ? 1 : 0;
            AddEvent(hasStayed ? ContactPhase.Stay : ContactPhase.Begin, in record);
        }

        for (; old < _previous.Count; old++)
        {
            AddEvent(ContactPhase.End, _previous[old] with { Impulse = 0 });
        }

        (_records, _previous) = (_previous, _records);
        _records.Clear();
    }

    /// <summary>Bodies that sleep touch what they touched before. Which triggers they are in is found anew in each step.</summary>
    private void KeepSleepers()
    {
        foreach (var record in _previous)
        {
            if (record.First < bodies.Count && bodies[record.First].IsAsleep
                && (record.Second < 0 ? !statics.Objects[ContactRecord.OfObject(record.Second)].IsTrigger
                    : record.Second < bodies.Count && bodies[record.Second].IsAsleep))
            {
                _records.Add(record with { Impulse = 0 });
            }
        }
    }

    private void Join()
    {
        var count = 0;
        foreach (var record in Records)
        {
            if (record.Second == ContactRecord.Unknown)
            {
                continue;
            }

            if (count > 0 && ContactRecord.Compare(_records[count - 1], record) == 0)
            {
                var joined = _records[count - 1];
                var larger = record.Impulse > joined.Impulse ? record : joined;
                _records[count - 1] = larger with { Impulse = joined.Impulse + record.Impulse };
            }
            else
            {
                _records[count++] = record;
            }
        }

        _records.RemoveRange(count, _records.Count - count);
    }

    private void AddEvent(ContactPhase phase, in ContactRecord record) => Events.Add(new(
        phase, bodies[record.First], record.Second >= 0 ? bodies[record.Second] : null,
        record.Second >= 0 ? null : statics.Objects[ContactRecord.OfObject(record.Second)], record.Point, record.Normal, record.Impulse));
}
