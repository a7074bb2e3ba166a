using System.Runtime.InteropServices;
using FractalEngine.Core.Physics.Bodies;
using FractalEngine.Core.Physics.Rows;
using FractalEngine.Core.Threading;

namespace FractalEngine.Core.Physics.Islands;

/// <summary>
/// Groups the bodies that a <see cref="ContactGraph"/> has joined: an island is made of two or more awake bodies that touch, directly or
/// through others. Islands and their bodies are in the order of the bodies' indices.
/// </summary>
internal sealed class IslandSet
{
    private readonly List<Body> _bodies;
    private readonly int _maxThreads;
    private readonly IslandRows _rows;
    private readonly IslandParts _parts = new();
    private readonly List<int> _islandBodies = [];

    // Places of the pairs that are contacts, one island after the other.
    private readonly List<int> _sortedPairs = [];
    private int[] _islandOf = [];
    private int[] _next = [0];
    private Island _cutIsland;

    private readonly List<int> _partPairs = [];
    private readonly List<int> _partEnds = [];
    private readonly List<int> _allPartBodyEnds = [];
    private readonly int[] _partStarts = new int[IslandParts.MaxCount + 2];
    private readonly List<int> _partBodies = [];
    private readonly int[] _partBodyEnds = new int[IslandParts.MaxCount];
    private readonly int[] _partRows = new int[IslandParts.MaxCount + 1];
    private readonly IslandRows.RowKinds[] _partKinds = new IslandRows.RowKinds[IslandParts.MaxCount + 1];
    private readonly Func<int, int> _islandOfBody;
    private readonly Func<int, int> _islandOfPair;
    private readonly Func<int, int> _partOfBody;
    private readonly Func<int, int> _partOfPair;

    public IslandSet(List<Body> bodies, NearbyBodies nearbyBodies, int maxThreads)
    {
        _bodies = bodies;
        _maxThreads = maxThreads;
        Graph = new(bodies, nearbyBodies, maxThreads);
        _rows = new(bodies, Graph.Copies);
        _islandOfBody = IslandOf;
        _islandOfPair = pair => Graph.Pairs[pair].IsRow ? IslandOf(Graph.Pairs[pair].First) : -1;
        _partOfBody = _parts.PartOf;
        _partOfPair = pair => _parts.PartOf(in Graph.Pairs[pair], _cutIsland.PartCount);
    }

    /// <summary>The bodies that touch or may meet.</summary>
    public ContactGraph Graph { get; }

    /// <summary>The islands, in the order of their lowest body.</summary>
    public List<Island> All { get; } = [];

    /// <summary>The contacts of an island.</summary>
    public Span<ContactRow> RowsOf(in Island island) => _rows.Range(island.FirstRow, island.RowCount);

    /// <summary>Number of contacts of all islands.</summary>
    public int RowCount => _rows.Count;

    /// <summary>Number of contacts that there is room for.</summary>
    public int RowCapacity => _rows.Capacity;

    /// <summary>A contact by its index among those of all islands, which stand one island after the other.</summary>
    public ref ContactRow Row(int index) => ref _rows[index];

    /// <summary>The bodies of an island, in the order of their indices.</summary>
    public ReadOnlySpan<int> BodiesOf(in Island island) =>
        CollectionsMarshal.AsSpan(_islandBodies).Slice(island.FirstBody, island.BodyCount);

    /// <summary>Number of bodies of all islands.</summary>
    public int BodyCount => _islandBodies.Count;

    /// <summary>Index of the island of a body; negative for none.</summary>
    public int IslandOf(int body) => _islandOf[body];

    /// <summary>Makes room for the bodies of a world and their contacts.</summary>
    public void Reserve(int bodyCount, int contactCount)
    {
        Graph.Reserve(bodyCount, contactCount);
        _parts.Reserve(bodyCount);
        _islandOf = new int[bodyCount];
        _next = new int[bodyCount + 1];
        _sortedPairs.EnsureCapacity(contactCount);
        _partPairs.EnsureCapacity(contactCount);
        _partEnds.EnsureCapacity(bodyCount);
        _allPartBodyEnds.EnsureCapacity(bodyCount);
        All.EnsureCapacity(bodyCount);
        _islandBodies.EnsureCapacity(bodyCount);
        _partBodies.EnsureCapacity(bodyCount);
        _rows.Reserve(contactCount);
    }

    /// <summary>Makes islands of the joined sets, and contacts of their pairs and surfaces.</summary>
    /// <param name="onlyImpacts">True to make none for islands that cannot bounce: their substeps have their impacts.</param>
    public void Group(bool onlyImpacts)
    {
        All.Clear();
        _islandBodies.Clear();
        _partEnds.Clear();
        _allPartBodyEnds.Clear();
        CollectBodies();
        _rows.Count = 0;
        if (onlyImpacts && All is [var only] && !MayBounce(BodiesOf(in only)))
        {
            return;
        }

        // Their order within an island stays.
        CountingSort.Sort(Graph.Pairs.Length, [], _islandOfPair, _next.AsSpan(0, All.Count), _sortedPairs);
        for (var island = 0; island < All.Count; island++)
        {
            var firstRow = _rows.Count;
            var firstPair = island > 0 ? _next[island - 1] : 0;
            var pairs = CollectionsMarshal.AsSpan(_sortedPairs)[firstPair.._next[island]];
            var partCount = All[island].HasCompound ? 1 : IslandParts.CountFor(pairs.Length);
            if (onlyImpacts && !MayBounce(BodiesOf(All[island])))
            {
                continue;
            }

            IslandRows.RowKinds kinds;
            if (partCount > 1)
            {
                All[island] = All[island] with { PartCount = partCount, FirstPartEnd = _partEnds.Count };
                _cutIsland = All[island];
                kinds = AddParts(BodiesOf(All[island]), pairs, partCount);
            }
            else
            {
                foreach (var body in BodiesOf(All[island]))
                {
                    _rows.AddSurfaces(_bodies[body]);
                }

                foreach (var pair in pairs)
                {
                    _rows.AddPair(in Graph.Pairs[pair]);
                }

                kinds = IslandRows.Examine(_rows.Range(firstRow, _rows.Count - firstRow));
            }

            All[island] = All[island] with
            {
                FirstRow = firstRow,
                RowCount = _rows.Count - firstRow,
                IsFree = (kinds & IslandRows.RowKinds.Immovable) == 0,
                HasMovingSurface = (kinds & IslandRows.RowKinds.Moving) != 0,
            };
        }
    }

    /// <summary>Makes an island of each set of two or more bodies, and lists its bodies.</summary>
    private void CollectBodies()
    {
        Array.Fill(_islandOf, -1, 0, _bodies.Count);
        for (var i = 0; Graph.Sets.JoinedCount > 0 && i < _bodies.Count; i++)
        {
            if (Graph.Sets.IsJoined(i))
            {
                var root = Graph.Sets.RootOf(i);
                if (root == i)
                {
                    _islandOf[i] = All.Count;
                    All.Add(new(0, 0, 0, 0));
                }

                // The lowest index stands for its set, so that it has come already.
                _islandOf[i] = _islandOf[root];
                var island = All[_islandOf[i]];
                All[_islandOf[i]] = island with
                {
                    BodyCount = island.BodyCount + 1,
                    HasCompound = island.HasCompound || Graph.Copies[i].IsCompound,
                };
            }
        }

        CountingSort.Sort(All.Count > 0 ? _bodies.Count : 0, [], _islandOfBody, _next.AsSpan(0, All.Count), _islandBodies);
        for (var island = 0; island < All.Count; island++)
        {
            All[island] = All[island] with { FirstBody = _next[island] - All[island].BodyCount };
        }
    }

    /// <summary>True where a body of some is not perfectly inelastic.</summary>
    public bool MayBounce(ReadOnlySpan<int> island)
    {
        foreach (var index in island)
        {
            if (Graph.Copies.MaterialOf(index).Restitution > 0)
            {
                return true;
            }
        }

        return false;
    }

    /// <summary>Puts islands to sleep whose bodies have all rested for some time.</summary>
    /// <param name="timeBeforeSleep">Seconds for which they must rest.</param>
    public void PutToSleep(double timeBeforeSleep)
    {
        foreach (var island in All)
        {
            var isResting = true;
            foreach (var index in BodiesOf(in island))
            {
                isResting &= _bodies[index].SleepTimer > 0 && _bodies[index].SleepTimer >= timeBeforeSleep;
            }

            foreach (var index in isResting ? BodiesOf(in island) : [])
            {
                _bodies[index].Sleep();
            }
        }
    }

    /// <summary>
    /// The ends of the contacts of each part of an island, and of those between parts, counted from its first; empty for a single part.
    /// </summary>
    public ReadOnlySpan<int> PartEndsOf(in Island island) => island.PartCount == 1 ? []
        : CollectionsMarshal.AsSpan(_partEnds).Slice(island.FirstPartEnd, island.PartCount + 1);

    /// <summary>Makes the contacts of an island part by part, and those across its cuts last. Threads share the parts.</summary>
    private IslandRows.RowKinds AddParts(ReadOnlySpan<int> island, ReadOnlySpan<int> pairs, int partCount)
    {
        var firstRow = _rows.Count;
        _parts.Cut(island, partCount, Graph.Copies.All);
        CountingSort.Sort(pairs.Length, pairs, _partOfPair, _partStarts.AsSpan(1, partCount + 1), _partPairs);
        SortBodiesByParts(island, partCount);
        WorkerSet.Shared.Run(partCount, _maxThreads, this, static (set, part) => set.CountSurfaces(part));
        _partRows[partCount] = 0;
        for (var part = 0; part <= partCount; part++)
        {
            var count = _partRows[part] + _partStarts[part + 1] - _partStarts[part];
            _partRows[part] = _rows.Count;
            _rows.Count += count;
            _partEnds.Add(_rows.Count - firstRow);
        }

        _rows.Reserve(_rows.Count);
        WorkerSet.Shared.Run(partCount + 1, _maxThreads, this, static (set, part) => set.FillPart(part));
        var kinds = IslandRows.RowKinds.None;
        foreach (var part in _partKinds.AsSpan(0, partCount + 1))
        {
            kinds |= part;
        }

        return kinds;
    }

    /// <summary>The bodies of a part of an island.</summary>
    public ReadOnlySpan<int> BodiesOfPart(in Island island, int part)
    {
        var members = BodiesOf(in island);
        if (island.PartCount == 1)
        {
            return part == 0 ? members : [];
        }

        var ends = CollectionsMarshal.AsSpan(_allPartBodyEnds).Slice(island.FirstPartEnd, island.PartCount + 1);
        return members[(part > 0 ? ends[part - 1] : 0)..ends[part]];
    }

    private void CountSurfaces(int part)
    {
        var count = 0;
        foreach (var index in BodiesOfPart(in _cutIsland, part))
        {
            count += _bodies[index].Contacts.SurfaceCount + _bodies[index].NearSurfaces.Count;
        }

        _partRows[part] = count;
    }

    private void FillPart(int part)
    {
        var place = _partRows[part];
        foreach (var index in BodiesOfPart(in _cutIsland, part))
        {
            _rows.FillSurfaces(_bodies[index], ball: 0, ref place);
        }

        var firstPair = place;
        var hasImmovable = false;
        var pairs = Graph.Pairs;
        foreach (var pair in CollectionsMarshal.AsSpan(_partPairs)[_partStarts[part].._partStarts[part + 1]])
        {
            hasImmovable |= pairs[pair].IsSecondImmovable;
            ref var row = ref _rows[place++];
            ContactRow.Clear(ref row);
            _rows.SetBalls(ref row, in pairs[pair]);
        }

        // Balls alone are neither immovable nor moving, unless one of them sleeps or is stuck.
        _partKinds[part] = IslandRows.Examine(_rows.Range(_partRows[part], firstPair - _partRows[part]))
            | (hasImmovable ? IslandRows.RowKinds.Immovable : IslandRows.RowKinds.None);
    }

    private void SortBodiesByParts(ReadOnlySpan<int> island, int partCount)
    {
        CountingSort.Sort(island.Length, island, _partOfBody, _partBodyEnds.AsSpan(0, partCount), _partBodies);
        for (var part = 0; part <= partCount; part++)
        {
            _allPartBodyEnds.Add(_partBodyEnds[Math.Min(part, partCount - 1)]);
        }

        CollectionsMarshal.AsSpan(_partBodies).CopyTo(CollectionsMarshal.AsSpan(_islandBodies)[_cutIsland.FirstBody..]);
    }
}
