using System.Numerics;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Fractals;

/// <summary>Writes what an item is compared by.</summary>
/// <param name="item">The item.</param>
/// <param name="entries">Receives 12 numbers, in triples of one kind: lengths, angles, factors, or a column of a matrix.</param>
/// <param name="tolerances">Receives by how much each triple may differ, [4].</param>
internal delegate void EntryWriter<T>(in T item, Span<double> entries, Span<double> tolerances);

/// <summary>Items of which no two are the same within the tolerances that belong to them, in the order in which they were added.</summary>
/// <remarks>
/// A hash table over the cells of a grid in the space of all entries. Cells are 16 to 32 tolerances wide, and follow those of each item in
/// powers of two. What is the same shares a cell, except where an entry lies within the tolerance of a cell's edge, or a tolerance near a
/// power of two: then the cell beyond is searched too. So no repetition is missed, and the cost is linear, unless very many items differ by
/// little more than rounding: then the list gives up.
/// </remarks>
/// <param name="write">Writes the entries of an item.</param>
/// <param name="capacity">Number of distinct items for which there is room, at least 1.</param>
internal sealed class DistinctList<T>(EntryWriter<T> write, int capacity)
{
    private const int EntryCount = 12;
    private const int TripleCount = 4;

    // No power of two, so that round numbers lie neither on the edges of cells nor between two sizes of cells.
    private const double MinTolerancesPerCell = 15.9717;

    // Two tolerances of the same item differ by rounding only.
    private const double ToleranceRounding = 1e-12;

    // The offset basis of the hash FNV-1a.
    private const ulong Seed = 14695981039346656037;

    // Some come from hashes with the same low bits.
    private const int ComparisonsPerItem = 64;

    // Comparing takes less than composing.
    private const int ComparisonsPerProduct = 8;

    private readonly T[] _items = GC.AllocateUninitializedArray<T>(capacity);

    // The next item whose hash begins with the same bits, and the first one of each such chain; −1 for none.
    private readonly int[] _next = GC.AllocateUninitializedArray<int>(capacity);
    private readonly int[] _first = EmptyChains(capacity);
    private long _comparisons;

    /// <summary>What comparing has cost so far, in products of maps: where these shrink to a point, each is compared with many.</summary>
    public long ComparisonCost => _comparisons / ComparisonsPerProduct;

    /// <summary>Number of distinct items.</summary>
    public int Count { get; private set; }

    /// <summary>The distinct items. Not copied.</summary>
    public ReadOnlyMemory<T> Items => _items.AsMemory(0, Count);

    /// <summary>Adds an item unless the same one was added before.</summary>
    /// <param name="item">The item.</param>
    /// <param name="maxCount">Maximum number of distinct items.</param>
    /// <returns>False if there are more, or if telling them apart takes too long.</returns>
    public bool TryAdd(in T item, long maxCount)
    {
        Span<double> entries = stackalloc double[EntryCount];
        Span<double> tolerances = stackalloc double[TripleCount];
        Write(in item, entries, tolerances);
        if (!Contains(entries, tolerances, stackalloc double[TripleCount], 0))
        {
            if (Count >= Math.Min(maxCount, _items.Length))
            {
                return false;
            }

            _items[Count] = item;
            ref var first = ref ChainOf(Hash(entries, tolerances));
            _next[Count] = first;
            first = Count++;
        }

        return _comparisons <= FractalLimits.ComparedProducts.Value + ((long)ComparisonsPerItem * _items.Length);
    }

    private static int[] EmptyChains(int capacity)
    {
        var first = GC.AllocateUninitializedArray<int>((int)Math.Min(BitOperations.RoundUpToPowerOf2((uint)capacity), 1u << 30));
        first.AsSpan().Fill(-1);
        return first;
    }

    private void Write(in T item, Span<double> entries, Span<double> tolerances)
    {
        write(in item, entries, tolerances);
        foreach (ref var tolerance in tolerances)
        {
            // What has left the range of a double is the same as nothing else.
            tolerance = double.IsFinite(tolerance) ? tolerance : 0;
        }
    }

    // The high bits are mixed best.
    private ref int ChainOf(ulong hash) => ref _first[(int)(hash >> 32) & (_first.Length - 1)];

    /// <summary>Computes the size of the cells for a tolerance: a power of two of a fixed size.</summary>
    private static double CellSize(double tolerance) =>
        tolerance > 0 ? Math.ScaleB(MinTolerancesPerCell, Math.ILogB(tolerance * MinTolerancesPerCell) - 3) : 0;

    private static ulong CombineHash(ulong hash, long cell)
    {
        hash = (hash ^ (ulong)cell) * HashMixing.GoldenGamma;
        return hash ^ (hash >> 29);
    }

    private static ulong Hash(ReadOnlySpan<double> entries, ReadOnlySpan<double> tolerances)
    {
        var hash = Seed;
        for (var i = 0; i < EntryCount; i++)
        {
            hash = CombineHash(hash, Quantize(entries[i], CellSize(tolerances[i / 3])).Cell);
        }

        return hash;
    }

    /// <summary>Computes the cell of an entry, and the entry's offset from the cell's centre, from −½ to ½ cells.</summary>
    private static (long Cell, double Offset) Quantize(double entry, double cellSize)
    {
        var position = cellSize > 0 ? entry / cellSize : 0;
        var cell = Math.Round(position);
        return ((long)cell, position - cell);
    }

    /// <summary>Searches for an equal item with each size of cells that it may have.</summary>
    /// <param name="entries">Entries of the item.</param>
    /// <param name="tolerances">By how much its triples may differ.</param>
    /// <param name="cellSizes">Room for the sizes of the cells of all triples; those before <paramref name="triple"/> are set.</param>
    /// <param name="triple">Index of the first triple without a size.</param>
    private bool Contains(ReadOnlySpan<double> entries, ReadOnlySpan<double> tolerances, Span<double> cellSizes, int triple)
    {
        if (triple == TripleCount)
        {
            return Contains(entries, tolerances, cellSizes, 0, Seed);
        }

        var smaller = CellSize(tolerances[triple] * (1 - ToleranceRounding));
        cellSizes[triple] = CellSize(tolerances[triple] * (1 + ToleranceRounding));
        if (Contains(entries, tolerances, cellSizes, triple + 1))
        {
            return true;
        }

        var hasOneSize = smaller == cellSizes[triple];
        cellSizes[triple] = smaller;
        return !hasOneSize && Contains(entries, tolerances, cellSizes, triple + 1);
    }

    /// <summary>Searches for an equal item in the cell of the entries, and beyond the edges that they are close to.</summary>
    /// <param name="entries">Entries of the item.</param>
    /// <param name="tolerances">By how much its triples may differ.</param>
    /// <param name="cellSizes">Sizes of the cells of its triples.</param>
    /// <param name="index">Number of the entries that are in the hash already.</param>
    /// <param name="hash">Hash of the cells of these entries.</param>
    private bool Contains(
        ReadOnlySpan<double> entries, ReadOnlySpan<double> tolerances, ReadOnlySpan<double> cellSizes, int index, ulong hash)
    {
        for (; index < EntryCount; index++)
        {
            var cellSize = cellSizes[index / 3];
            var (cell, offset) = Quantize(entries[index], cellSize);
            if (0.5 - Math.Abs(offset) <= 2 * tolerances[index / 3] / cellSize
                && Contains(entries, tolerances, cellSizes, index + 1, CombineHash(hash, cell + Math.Sign(offset))))
            {
                return true;
            }

            hash = CombineHash(hash, cell);
        }

        return ContainsInChain(entries, tolerances, hash);
    }

    private bool ContainsInChain(ReadOnlySpan<double> entries, ReadOnlySpan<double> tolerances, ulong hash)
    {
        Span<double> otherEntries = stackalloc double[EntryCount];
        Span<double> otherTolerances = stackalloc double[TripleCount];
        for (var candidate = ChainOf(hash); candidate >= 0; candidate = _next[candidate])
        {
            _comparisons++;
            Write(in _items[candidate], otherEntries, otherTolerances);
            var areSame = true;
            for (var i = 0; i < EntryCount && areSame; i++)
            {
                areSame = Math.Abs(entries[i] - otherEntries[i]) <= Math.Max(tolerances[i / 3], otherTolerances[i / 3]);
            }

            if (areSame)
            {
                return true;
            }
        }

        return false;
    }
}
