using System.Runtime.InteropServices;

namespace FractalEngine.Core.Physics.Islands;

/// <content>The parts of large islands, which threads share out.</content>
internal sealed partial class ContactGraph
{
    private readonly IslandParts _parts = new();
    private readonly List<int> _partPairs = new(InitialCapacity);
    private readonly List<int> _partEnds = new(InitialCapacity);
    private readonly int[] _partStarts = new int[IslandParts.MaxCount + 2];

    /// <summary>
    /// The ends of the contacts of each part of an island, and of those between parts, counted from its first; empty for a single part.
    /// </summary>
    public ReadOnlySpan<int> PartEndsOf(in Island island) => island.PartCount == 1 ? []
        : CollectionsMarshal.AsSpan(_partEnds).Slice(island.FirstPartEnd, island.PartCount + 1);

    /// <summary>The contacts of a part of an island, or those between its parts.</summary>
    /// <param name="island">The island.</param>
    /// <param name="part">Index of the part; the number of parts for the contacts between them.</param>
    public Span<ContactRow> RowsOfPart(in Island island, int part)
    {
        if (island.PartCount == 1)
        {
            return part == 0 ? RowsOf(in island) : [];
        }

        var ends = PartEndsOf(in island);
        var start = part > 0 ? ends[part - 1] : 0;
        return _rows.AsSpan(island.FirstRow + start, ends[part] - start);
    }

    /// <summary>The part of a body of an island that has several.</summary>
    public int PartOf(int body) => _parts.PartOf(body);

    /// <summary>Makes the contacts of an island part by part, and those across its cuts last.</summary>
    private void AddParts(ReadOnlySpan<int> island, ReadOnlySpan<int> pairs, int partCount)
    {
        var firstRow = _count;
        _parts.Cut(island, partCount, _states);
        SortByParts(pairs, partCount);
        for (var part = 0; part <= partCount; part++)
        {
            foreach (var index in part < partCount ? island : [])
            {
                if (_parts.PartOf(index) == part)
                {
                    AddSurfaces(bodies[index]);
                }
            }

            AddPairs(CollectionsMarshal.AsSpan(_partPairs)[_partStarts[part].._partStarts[part + 1]]);
            _partEnds.Add(_count - firstRow);
        }
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
