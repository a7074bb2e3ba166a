using System.Runtime.InteropServices;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Physics.Islands;

/// <content>How contacts and bodies are put into the order of their islands.</content>
internal sealed partial class ContactGraph
{
    /// <summary>Makes islands of the joined sets, and contacts of their pairs and surfaces.</summary>
    public void Group()
    {
        _islands.Clear();
        _islandBodies.Clear();
        CollectBodies();
        _count = 0;
        foreach (var index in _islandBodies)
        {
            AddSurfaces(index);
        }

        foreach (ref readonly var pair in CollectionsMarshal.AsSpan(_pairs))
        {
            if (pair.IsRow && _islandOf[pair.First] >= 0)
            {
                AddPair(in pair);
            }
        }

        PlaceRows();
    }

    /// <summary>Makes an island of each set of two or more bodies, and lists its bodies.</summary>
    private void CollectBodies()
    {
        for (var i = 0; i < bodies.Count; i++)
        {
            _islandOf[i] = -1;
            if (_sets.IsJoined(i))
            {
                var root = _sets.RootOf(i);
                if (root == i)
                {
                    _islandOf[i] = _islands.Count;
                    _islands.Add(default);
                }

                // The lowest index stands for its set, so that it has come already.
                _islandOf[i] = _islandOf[root];
                _islands[_islandOf[i]] = _islands[_islandOf[i]] with { BodyCount = _islands[_islandOf[i]].BodyCount + 1 };
            }
        }

        var firstBody = 0;
        for (var island = 0; island < _islands.Count; island++)
        {
            _islands[island] = _islands[island] with { FirstBody = firstBody };
            _next[island] = firstBody;
            firstBody += _islands[island].BodyCount;
        }

        CollectionsMarshal.SetCount(_islandBodies, firstBody);
        for (var i = 0; i < bodies.Count; i++)
        {
            if (_islandOf[i] >= 0)
            {
                _islandBodies[_next[_islandOf[i]]++] = i;
            }
        }
    }

    /// <summary>Sorts the contacts by islands, and keeps their order within each.</summary>
    private void PlaceRows()
    {
        RowCount = _count;
        if (_rows.Length < _count)
        {
            _rows = new ContactRow[_found.Length];
        }

        for (var i = 0; i < _count; i++)
        {
            var island = _islandOf[_found[i].First];
            _islands[island] = _islands[island] with { RowCount = _islands[island].RowCount + 1 };
        }

        var firstRow = 0;
        for (var island = 0; island < _islands.Count; island++)
        {
            _islands[island] = _islands[island] with { FirstRow = firstRow };
            _next[island] = firstRow;
            firstRow += _islands[island].RowCount;
        }

        for (var i = 0; i < _count; i++)
        {
            _rows[_next[_islandOf[_found[i].First]]++] = _found[i];
        }
    }

    private void AddSurfaces(int index)
    {
        var body = bodies[index];
        for (var i = 0; i < body.Contacts.Count; i++)
        {
            if (body.Contacts[i] is { IsBody: false } contact)
            {
                AddSurface(index, in contact, isAhead: false);
            }
        }

        for (var i = 0; i < body.NearSurfaceCount; i++)
        {
            ref readonly var near = ref body.NearSurfaces[i];
            var gap = Vector.Dot(near.PointToCentre(body.Position), near.CachedNormal) - body.Radius;
            AddSurface(index, in near, gap > ContactTolerances.Slop(body.Radius, body.Position));
            _found[_count - 1].Normal = near.CachedNormal;
        }
    }

    private void AddSurface(int index, in Contact contact, bool isAhead)
    {
        var body = bodies[index];
        ref var row = ref AddRow();
        row.First = index;
        row.Second = ContactRow.Firm;
        row.Offset = contact.PointToCentre(body.Position);
        row.MinDistance = body.Radius;
        row.Normal = row.Offset.UnitVectorOrZero();
        row.FirstRadius = body.Radius;
        if (contact.Kinematic is { } kinematic)
        {
            row.SurfaceVelocity = contact.SurfaceVelocity(body.Position);
            row.SurfaceSpin = kinematic.AngularVelocity;
            row.SurfaceWay = _stepLength * kinematic.VelocityAt(contact.Point);
        }

        row.Friction = body.Description.Friction;
        row.Restitution = body.Description.Restitution;
        row.IsAhead = isAhead;
        row.RollingArm = body.Description.RollingFriction * body.Radius;
        row.SpinningArm = body.Description.SpinningFriction * body.Radius;
    }

    private void AddPair(in BodyPair pair)
    {
        var body = bodies[pair.First];
        var other = bodies[pair.Second];
        var radius = Math.Min(body.Radius, other.Radius);
        ref var row = ref AddRow();
        row.First = pair.First;
        row.Second = pair.IsSecondFirm ? ContactRow.Firm : pair.Second;
        row.Offset = body.Position - other.Position;
        row.MinDistance = body.Radius + other.Radius;
        row.Normal = row.Offset.UnitVectorOrZero();
        row.FirstRadius = body.Radius;
        row.SecondRadius = other.Radius;
        row.IsBall = true;
        row.IsAhead = !pair.IsTouching;
        row.Friction = Math.Min(body.Description.Friction, other.Description.Friction);
        // What bounces first goes as far as it touches only, and would be overrun.
        row.Restitution =
            row.IsAhead && IsPushed(in pair) ? 0 : Math.Min(body.Description.Restitution, other.Description.Restitution);
        row.RollingArm = radius * Math.Min(body.Description.RollingFriction, other.Description.RollingFriction);
        row.SpinningArm = radius * Math.Min(body.Description.SpinningFriction, other.Description.SpinningFriction);
    }

    private ref ContactRow AddRow()
    {
        if (_count == _found.Length)
        {
            Array.Resize(ref _found, 2 * _found.Length);
        }

        _found[_count] = default;
        return ref _found[_count++];
    }
}
