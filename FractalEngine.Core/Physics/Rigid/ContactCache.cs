using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Descriptions;

namespace FractalEngine.Core.Physics.Rigid;

/// <summary>The impulses of contacts in the last part of a step, with which those that are near them begin.</summary>
internal sealed class ContactCache
{
    // Cosine of the angle between the normals of the same contact.
    private const double MinCosine = 0.95;

    // Relative to the radius of the smaller body: how far a contact may have moved.
    private const double MaxDistance = 0.03;

    private readonly Dictionary<long, Range> _ranges = [];
    private readonly List<Entry> _entries = [];

    /// <summary>Forgets the contacts of all pairs.</summary>
    public void Clear()
    {
        _ranges.Clear();
        _entries.Clear();
    }

    /// <summary>Keeps the contacts of a pair.</summary>
    /// <param name="pair">The pair.</param>
    /// <param name="rows">Its contacts, solved.</param>
    /// <param name="first">Orientation of the first surface when the contacts were found.</param>
    public void Store(in RigidPair pair, ReadOnlySpan<RigidRow> rows, in Orientation first)
    {
        var start = _entries.Count;
        foreach (ref readonly var row in rows)
        {
            if (row.NormalImpulse > 0)
            {
                _entries.Add(new(
                    first.RotateBack(row.Arm1), row.Normal, row.NormalImpulse, row.FrictionImpulse, row.RollingImpulse));
            }
        }

        if (_entries.Count > start)
        {
            _ranges[pair.Key] = start.._entries.Count;
        }
    }

    /// <summary>Gives a contact the impulses of the nearest one that there was.</summary>
    /// <param name="pair">Its pair.</param>
    /// <param name="row">The contact.</param>
    /// <param name="first">Orientation of the first surface.</param>
    /// <param name="radius">Radius of the smaller body.</param>
    public void WarmStart(in RigidPair pair, ref RigidRow row, in Orientation first, double radius)
    {
        if (!_ranges.TryGetValue(pair.Key, out var range))
        {
            return;
        }

        var arm = first.RotateBack(row.Arm1);
        var nearest = MaxDistance * radius;
        for (var i = range.Start.Value; i < range.End.Value; i++)
        {
            var entry = _entries[i];
            var distance = (entry.Arm - arm).Length();
            if (distance < nearest && Vector.Dot(entry.Normal, row.Normal) > MinCosine)
            {
                nearest = distance;
                row.NormalImpulse = entry.NormalImpulse;
                row.FrictionImpulse = entry.FrictionImpulse - (Vector.Dot(entry.FrictionImpulse, row.Normal) * row.Normal);
                row.RollingImpulse = entry.RollingImpulse;
            }
        }
    }

    private readonly record struct Entry(
        Vector Arm, Vector Normal, double NormalImpulse, Vector FrictionImpulse, Vector RollingImpulse);
}
