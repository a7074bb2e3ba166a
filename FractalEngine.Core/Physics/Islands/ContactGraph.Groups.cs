using System.Runtime.InteropServices;

namespace FractalEngine.Core.Physics.Islands;

/// <content>How bodies and pairs are put into the order of their islands.</content>
internal sealed partial class ContactGraph
{
    // Places of the pairs that are contacts, one island after the other.
    private readonly List<int> _sortedPairs = [];
    private int[] _islandOf = [];
    private int[] _next = [0];
    private Island _cutIsland;

    /// <summary>Makes islands of the joined sets, and contacts of their pairs and surfaces.</summary>
    /// <param name="onlyImpacts">True to make none for islands that cannot bounce: their substeps have their impacts.</param>
    public void Group(bool onlyImpacts)
    {
        _islands.Clear();
        _islandBodies.Clear();
        _partEnds.Clear();
        _allPartBodyEnds.Clear();
        CollectBodies();
        _count = 0;
        RowCount = 0;
        if (onlyImpacts && _islands is [var only] && !MayBounce(BodiesOf(in only)))
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
            if (onlyImpacts && !MayBounce(BodiesOf(_islands[island])))
            {
                continue;
            }

            RowKinds kinds;
            if (partCount > 1)
            {
                _islands[island] = _islands[island] with { PartCount = partCount, FirstPartEnd = _partEnds.Count };
                _cutIsland = _islands[island];
                kinds = AddParts(BodiesOf(_islands[island]), pairs, partCount);
            }
            else
            {
                foreach (var body in BodiesOf(_islands[island]))
                {
                    AddSurfaces(bodies[body]);
                }

                foreach (var pair in pairs)
                {
                    AddPair(in CollectionsMarshal.AsSpan(_pairs)[pair]);
                }

                kinds = Examine(_rows.AsSpan(firstRow, _count - firstRow));
            }

            _islands[island] = _islands[island] with
            {
                FirstRow = firstRow,
                RowCount = _count - firstRow,
                IsFree = (kinds & RowKinds.Immovable) == 0,
                HasMovingSurface = (kinds & RowKinds.Moving) != 0,
            };
        }

        RowCount = _count;
    }

    /// <summary>Makes an island of each set of two or more bodies, and lists its bodies.</summary>
    private void CollectBodies()
    {
        Array.Fill(_islandOf, -1, 0, bodies.Count);
        for (var i = 0; _sets.JoinedCount > 0 && i < bodies.Count; i++)
        {
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
                    BodyCount = island.BodyCount + 1,
                    HasCompound = island.HasCompound || _states[i].IsCompound,
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
        for (var i = 0; firstBody > 0 && i < bodies.Count; i++)
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
}
