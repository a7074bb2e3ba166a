using System.Runtime.InteropServices;
using FractalEngine.Core.Physics.Compounds;

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
            AddSurfaces(bodies[index]);
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
            _islands[island] = _islands[island] with
            {
                RowCount = _islands[island].RowCount + 1,
                HasCompound = _islands[island].HasCompound || _found[i].HasArms,
            };
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

    private void AddSurfaces(Body body)
    {
        var firstRow = _count;
        for (var ball = 0; ball < body.Balls.Length; ball++)
        {
            AddSurfaces(body, ball, body.Balls[ball].Contacts, body.Balls[ball].NearSurfaces);
        }

        if (body.Description.Shape is { IsCapsule: true })
        {
            _count = firstRow + CapsuleRows.RemoveInner(_found.AsSpan(firstRow, _count - firstRow));
        }

        if (!body.IsCompound)
        {
            AddSurfaces(body, 0, body.Contacts, body.NearSurfaces);
        }
    }

    private void AddSurfaces(Body body, int ball, ContactSet contacts, NearSurfaceList nearSurfaces)
    {
        for (var i = 0; i < contacts.Count; i++)
        {
            if (contacts[i] is { IsBody: false } contact)
            {
                AddRow() = ContactRows.OfSurface(body, ball, in contact, isAhead: false, _stepLength);
            }
        }

        for (var i = 0; i < nearSurfaces.Count; i++)
        {
            AddRow() = ContactRows.OfNearSurface(body, ball, in nearSurfaces[i], _stepLength);
        }
    }

    private void AddPair(in BodyPair pair)
    {
        var body = bodies[pair.First];
        var other = bodies[pair.Second];
        if (!body.IsCompound && !other.IsCompound)
        {
            AddBalls(in pair, 0, 0, !pair.IsTouching);
            return;
        }

        var limit = DeviationLimit(pair.First) + (_stepLength * body.AngularVelocity.Length() * body.MaxArm)
            + (_stepLength * RelativeVelocity(in pair).Length());
        limit += pair.IsSecondFirm ? 0 : DeviationLimit(pair.Second) + (_stepLength * other.AngularVelocity.Length() * other.MaxArm);
        for (var i = 0; i < body.BallCount; i++)
        {
            for (var j = 0; j < other.BallCount; j++)
            {
                var gap = BallPairs.Gap(body, i, other, j);
                if (gap <= limit)
                {
                    AddBalls(in pair, i, j, gap > ContactTolerances.Slop(Math.Min(body.BallRadius(i), other.BallRadius(j)), body.Position));
                }
            }
        }
    }

    private void AddBalls(in BodyPair pair, int ball, int otherBall, bool isAhead)
    {
        ref var row = ref AddRow();
        row = ContactRows.OfBalls(bodies[pair.First], ball, bodies[pair.Second], otherBall, pair.IsSecondFirm, isAhead);
        // What bounces first goes as far as it touches only, and would be overrun.
        row.Restitution = isAhead && IsPushed(in pair) ? 0 : row.Restitution;
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
