using System.Runtime.InteropServices;
using FractalEngine.Core.Physics.Rows;
using FractalEngine.Core.Threading;

namespace FractalEngine.Core.Physics.Islands;

/// <content>The parts of large islands, which threads share out.</content>
internal sealed partial class ContactGraph
{
    private readonly IslandParts _parts = new();
    private readonly List<int> _partPairs = [];
    private readonly List<int> _partEnds = [];
    private readonly List<int> _allPartBodyEnds = [];
    private readonly int[] _partStarts = new int[IslandParts.MaxCount + 2];
    private readonly List<int> _partBodies = [];
    private readonly int[] _partBodyEnds = new int[IslandParts.MaxCount];
    private readonly int[] _partRows = new int[IslandParts.MaxCount + 1];
    private readonly RowKinds[] _partKinds = new RowKinds[IslandParts.MaxCount + 1];
    private Action<int>? _countSurfaces;
    private Action<int>? _fillPart;
    private int _partCount;
    private int _sortedStart;

    /// <summary>
    /// The ends of the contacts of each part of an island, and of those between parts, counted from its first; empty for a single part.
    /// </summary>
    public ReadOnlySpan<int> PartEndsOf(in Island island) => island.PartCount == 1 ? []
        : CollectionsMarshal.AsSpan(_partEnds).Slice(island.FirstPartEnd, island.PartCount + 1);

    /// <summary>Makes the contacts of an island part by part, and those across its cuts last. Threads share the parts.</summary>
    private RowKinds AddParts(ReadOnlySpan<int> island, ReadOnlySpan<int> pairs, int partCount)
    {
        var firstRow = _count;
        _partCount = partCount;
        _sortedStart = _cutIsland.FirstBody;
        _parts.Cut(island, partCount, _states);
        SortByParts(pairs, partCount);
        SortBodiesByParts(island, partCount);
        WorkerSet.Shared.Run(partCount, maxThreads, _countSurfaces!);
        _partRows[partCount] = 0;
        for (var part = 0; part <= partCount; part++)
        {
            var count = _partRows[part] + _partStarts[part + 1] - _partStarts[part];
            _partRows[part] = _count;
            _count += count;
            _partEnds.Add(_count - firstRow);
        }

        ReserveRows(_count);
        WorkerSet.Shared.Run(partCount + 1, maxThreads, _fillPart!);
        var kinds = RowKinds.None;
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

    private ReadOnlySpan<int> BodiesOfPart(int part)
    {
        var first = part > 0 ? _partBodyEnds[part - 1] : 0;
        return part < _partCount ? CollectionsMarshal.AsSpan(_partBodies)[first.._partBodyEnds[part]] : [];
    }

    private void CountSurfaces(int part)
    {
        var count = 0;
        foreach (var index in BodiesOfPart(part))
        {
            count += bodies[index].Contacts.SurfaceCount + bodies[index].NearSurfaces.Count;
        }

        _partRows[part] = count;
    }

    private void FillPart(int part)
    {
        var place = _partRows[part];
        foreach (var index in BodiesOfPart(part))
        {
            FillSurfaces(bodies[index], ball: 0, ref place);
        }

        var firstPair = place;
        var hasImmovable = false;
        var pairs = CollectionsMarshal.AsSpan(_pairs);
        foreach (var pair in CollectionsMarshal.AsSpan(_partPairs)[_partStarts[part].._partStarts[part + 1]])
        {
            hasImmovable |= pairs[pair].IsSecondImmovable;
            ref var row = ref _rows[place++];
            ContactRow.Clear(ref row);
            SetBalls(ref row, in pairs[pair]);
        }

        // Balls alone are neither immovable nor moving, unless one of them sleeps or is stuck.
        _partKinds[part] = Examine(_rows.AsSpan(_partRows[part], firstPair - _partRows[part]))
            | (hasImmovable ? RowKinds.Immovable : RowKinds.None);
    }

    private void SortBodiesByParts(ReadOnlySpan<int> island, int partCount)
    {
        Array.Clear(_partBodyEnds);
        foreach (var index in island)
        {
            _partBodyEnds[_parts.PartOf(index)]++;
        }

        var start = 0;
        for (var part = 0; part < partCount; part++)
        {
            (_partBodyEnds[part], start) = (start, start + _partBodyEnds[part]);
        }

        CollectionsMarshal.SetCount(_partBodies, island.Length);
        var sorted = CollectionsMarshal.AsSpan(_partBodies);
        foreach (var index in island)
        {
            // Each entry is the end of its part afterwards.
            sorted[_partBodyEnds[_parts.PartOf(index)]++] = index;
        }

        for (var part = 0; part <= partCount; part++)
        {
            _allPartBodyEnds.Add(_partBodyEnds[Math.Min(part, partCount - 1)]);
        }

        sorted.CopyTo(CollectionsMarshal.AsSpan(_islandBodies)[_sortedStart..]);
    }

    private void SortByParts(ReadOnlySpan<int> pairs, int partCount)
    {
        var known = CollectionsMarshal.AsSpan(_pairs);
        Array.Clear(_partStarts);
        foreach (var pair in pairs)
        {
            _partStarts[_parts.PartOf(in known[pair], partCount)]++;
        }

        var end = 0;
        for (var part = 0; part <= partCount; part++)
        {
            end += _partStarts[part];
            _partStarts[part] = end;
        }

        _partStarts[partCount + 1] = end;
        CollectionsMarshal.SetCount(_partPairs, pairs.Length);
        for (var i = pairs.Length - 1; i >= 0; i--)
        {
            _partPairs[--_partStarts[_parts.PartOf(in known[pairs[i]], partCount)]] = pairs[i];
        }
    }
}
