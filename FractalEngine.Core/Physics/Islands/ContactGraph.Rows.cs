using System.Runtime.InteropServices;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Compounds;

namespace FractalEngine.Core.Physics.Islands;

/// <content>How contacts and bodies are put into the order of their islands.</content>
internal sealed partial class ContactGraph
{
    // Places of the pairs that are contacts, one island after the other.
    private readonly List<int> _sortedPairs = new(InitialCapacity);
    private ContactRow[] _rows = new ContactRow[InitialCapacity];
    private int[] _islandOf = new int[InitialCapacity];
    private int[] _next = new int[InitialCapacity];
    private int _count;

    /// <summary>Makes islands of the joined sets, and contacts of their pairs and surfaces.</summary>
    /// <param name="onlyImpacts">True to make none for large islands that cannot bounce: their step's solve has their impacts.</param>
    public void Group(bool onlyImpacts)
    {
        _islands.Clear();
        _islandBodies.Clear();
        _partEnds.Clear();
        CollectBodies();
        _count = 0;
        RowCount = 0;
        if (onlyImpacts && _islands is [var only] && Island.IsLargeFor(_pairs.Count, only.HasCompound) && !MayBounce(BodiesOf(in only)))
        {
            return;
        }

        SortPairs();
        for (var island = 0; island < _islands.Count; island++)
        {
            var firstRow = _count;
            var firstPair = island > 0 ? _next[island - 1] : 0;
            var pairs = CollectionsMarshal.AsSpan(_sortedPairs)[firstPair.._next[island]];
            var partCount = _islands[island].HasCompound ? 1 : IslandParts.CountFor(pairs.Length);
            if (onlyImpacts && Island.IsLargeFor(pairs.Length, _islands[island].HasCompound) && !MayBounce(BodiesOf(_islands[island])))
            {
                continue;
            }

            RowKinds kinds;
            if (partCount > 1)
            {
                _islands[island] = _islands[island] with { PartCount = partCount, FirstPartEnd = _partEnds.Count };
                kinds = AddParts(BodiesOf(_islands[island]), pairs, partCount);
            }
            else
            {
                AddSurfaces(BodiesOf(_islands[island]));
                AddPairs(pairs);
                kinds = Examine(_rows.AsSpan(firstRow, _count - firstRow));
            }

            _islands[island] = _islands[island] with
            {
                FirstRow = firstRow,
                RowCount = _count - firstRow,
                IsFree = (kinds & RowKinds.Firm) == 0,
                IsPushed = (kinds & RowKinds.Pushing) != 0,
                HasMovingSurface = (kinds & RowKinds.Moving) != 0,
            };
        }

        RowCount = _count;
    }

    private static RowKinds Examine(ReadOnlySpan<ContactRow> rows)
    {
        var kinds = RowKinds.None;
        foreach (ref readonly var row in rows)
        {
            kinds |= row.Second >= 0 ? RowKinds.None : RowKinds.Firm;
            kinds |= row.SurfaceWay != Vector.Zero ? RowKinds.Pushing : RowKinds.None;
            kinds |= row.IsOnMovingSurface ? RowKinds.Moving : RowKinds.None;
        }

        return kinds;
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
                    _islands.Add(new(0, 0, 0, 0));
                }

                // The lowest index stands for its set, so that it has come already.
                _islandOf[i] = _islandOf[root];
                var island = _islands[_islandOf[i]];
                _islands[_islandOf[i]] = island with
                {
                    BodyCount = island.BodyCount + 1, HasCompound = island.HasCompound || _states[i].IsCompound,
                };
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

    /// <summary>Sorts the pairs that are contacts by islands, and keeps their order within each.</summary>
    private void SortPairs()
    {
        Array.Clear(_next, 0, _islands.Count + 1);
        var pairs = CollectionsMarshal.AsSpan(_pairs);
        foreach (ref readonly var pair in pairs)
        {
            if (pair.IsRow && _islandOf[pair.First] >= 0)
            {
                _next[_islandOf[pair.First] + 1]++;
            }
        }

        for (var island = 0; island < _islands.Count; island++)
        {
            _next[island + 1] += _next[island];
        }

        CollectionsMarshal.SetCount(_sortedPairs, _next[_islands.Count]);
        for (var i = 0; i < pairs.Length; i++)
        {
            if (pairs[i].IsRow && _islandOf[pairs[i].First] >= 0)
            {
                // Each entry is the end of its island afterwards.
                _sortedPairs[_next[_islandOf[pairs[i].First]]++] = i;
            }
        }
    }

    /// <summary>True where a body of some is not perfectly inelastic.</summary>
    public bool MayBounce(ReadOnlySpan<int> island)
    {
        foreach (var index in island)
        {
            if (_materials[index].Restitution > 0)
            {
                return true;
            }
        }

        return false;
    }

    private void AddSurfaces(ReadOnlySpan<int> island)
    {
        foreach (var index in island)
        {
            AddSurfaces(bodies[index]);
        }
    }

    private void AddPairs(ReadOnlySpan<int> pairs)
    {
        foreach (var pair in pairs)
        {
            AddPair(in CollectionsMarshal.AsSpan(_pairs)[pair]);
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
            _count = firstRow + CapsuleRows.RemoveInner(_rows.AsSpan(firstRow, _count - firstRow));
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
        if (!_states[pair.First].IsCompound && !_states[pair.Second].IsCompound)
        {
            SetBalls(ref AddRow(), in pair);
            return;
        }

        var body = bodies[pair.First];
        var other = bodies[pair.Second];
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
        ContactRows.SetBalls(ref row, bodies[pair.First], ball, bodies[pair.Second], otherBall, pair.IsSecondFirm, isAhead);
        RemoveRestitution(ref row, in pair);
    }

    /// <summary>Sets the contact of two bodies that are one ball each.</summary>
    private void SetBalls(ref ContactRow row, in BodyPair pair)
    {
        ref readonly var first = ref _states[pair.First];
        ref readonly var second = ref _states[pair.Second];
        row.First = pair.First;
        row.Second = pair.IsSecondFirm ? ContactRow.Firm : pair.Second;
        row.IsAhead = !pair.IsTouching;
        ContactRows.SetBalls(ref row, first.Position - second.Position, first.Radius, second.Radius);
        ContactRows.SetMaterials(ref row, in _materials[pair.First], in _materials[pair.Second]);
        RemoveRestitution(ref row, in pair);
    }

    /// <summary>What bounces first goes as far as it touches only, and would be overrun by what is pushed.</summary>
    private void RemoveRestitution(ref ContactRow row, in BodyPair pair) =>
        row.Restitution = row.IsAhead && IsPushed(in pair) ? 0 : row.Restitution;

    private ref ContactRow AddRow()
    {
        ReserveRows(_count + 1);
        ContactRow.Clear(ref _rows[_count]);
        return ref _rows[_count++];
    }

    private void ReserveRows(int count)
    {
        if (_rows.Length < count)
        {
            Array.Resize(ref _rows, Math.Max(count, 2 * _rows.Length));
        }
    }

    /// <summary>What is among contacts: something firm, what pushes, and what moves.</summary>
    [Flags]
    private enum RowKinds
    {
        None = 0,
        Firm = 1,
        Pushing = 2,
        Moving = 4,
    }
}
