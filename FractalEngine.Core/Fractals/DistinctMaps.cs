using System.Numerics;
using FractalEngine.Core.Maths;
using Vector = FractalEngine.Core.Maths.Vector;

namespace FractalEngine.Core.Fractals;

/// <summary>
/// Removes repeated maps from a list. Two maps count as equal when no entry differs by more than <see cref="RelativeTolerance"/> of the
/// largest entry of its kind in the list.
/// </summary>
/// <remarks>
/// The same sum or product in another order differs by rounding only, which the tolerance covers. Entries are rounded to the cells of a
/// grid about 2¹⁶ times coarser than the tolerance, and hashed. Equal maps share a cell, except where an entry lies within the tolerance of
/// a cell's edge: then the cell beyond is searched too. So no repetition is missed, and the cost is linear.
/// </remarks>
internal static class DistinctMaps
{
    /// <summary>64 units in the last place, which covers the sum of a few dozen roundings.</summary>
    public const double RelativeTolerance = 64 * 2.220446049250313e-16;

    private const int EntryCount = 12;

    // Width of a cell in tolerances. It is no power of two, so that round numbers do not lie on the cells' edges.
    private const double TolerancesPerCell = 65521.7;

    /// <summary>Keeps the first of each group of equal maps, in order.</summary>
    /// <param name="maps">Changed: its room is used.</param>
    public static ReadOnlyMemory<AffineMap> Deduplicate(AffineMap[] maps) => Distinct(maps, WriteMap);

    /// <summary>
    /// Keeps the first of each group of equal products m1·m2, in the order of <see cref="FractalGenerator.ConcatenatePair"/>: the same maps
    /// as those of <see cref="Deduplicate(AffineMap[])"/>, without an array of all pairs.
    /// </summary>
    /// <param name="outer">The maps m1.</param>
    /// <param name="inner">The maps m2.</param>
    /// <param name="maxCount">Maximum number of distinct products.</param>
    /// <returns>The distinct products; null if there are more.</returns>
    public static ReadOnlyMemory<AffineMap>? DeduplicateProducts(
        ReadOnlySpan<AffineMap> outer, ReadOnlySpan<AffineMap> inner, long maxCount) => DistinctProducts(
            outer, inner, static (in AffineMap m1, in AffineMap m2) => m1 * m2, WriteMap, maxCount);

    /// <summary>
    /// Keeps the first of each group of equal componentwise compositions, without an array of all pairs: those of the first transformation
    /// with all sums, then those of the second, and so on.
    /// </summary>
    /// <param name="transformations">The transformations of one level.</param>
    /// <param name="sums">The sums so far.</param>
    /// <param name="maxCount">Maximum number of distinct sums.</param>
    /// <returns>The distinct sums; null if there are more.</returns>
    /// <remarks>Angles are compared as numbers, so 360° differs from 0°.</remarks>
    public static ReadOnlyMemory<Transformation>? DeduplicateSums(
        ReadOnlySpan<Transformation> transformations, ReadOnlySpan<Transformation> sums, long maxCount) => DistinctProducts(
            transformations, sums,
            static (in Transformation added, in Transformation sum) => Transformation.ComposeComponentwise(sum, added),
            WriteTransformation, maxCount);

    private static ReadOnlyMemory<T>? DistinctProducts<T>(
        ReadOnlySpan<T> outer, ReadOnlySpan<T> inner, Composer<T> compose, EntryWriter<T> write, long maxCount)
    {
        // All products are multiplied twice, since the tolerance depends on the largest entries.
        Span<double> maxEntries = stackalloc double[EntryCount];
        Span<double> entries = stackalloc double[EntryCount];
        foreach (ref readonly var m1 in outer)
        {
            foreach (ref readonly var m2 in inner)
            {
                write(compose(m1, m2), entries);
                TakeLarger(maxEntries, entries);
            }
        }

        ShareWithinTriples(maxEntries);
        // Not more than one beyond the limit, and without growing, which would leave garbage as large.
        var room = Math.Min(((long)outer.Length * inner.Length) - 1, maxCount) + 1;
        var grid = new HashGrid<T>(write, maxEntries, GC.AllocateUninitializedArray<T>((int)Math.Clamp(room, 1, Array.MaxLength)));
        foreach (ref readonly var m1 in outer)
        {
            foreach (ref readonly var m2 in inner)
            {
                grid.Add(compose(m1, m2));
                if (grid.Count > maxCount)
                {
                    return null;
                }
            }
        }

        return grid.Items;
    }

    private static void WriteTransformation(in Transformation transformation, Span<double> entries)
    {
        WriteTriple(transformation.Position, entries);
        WriteTriple(transformation.Rotation, entries[3..]);
        WriteTriple(transformation.Scale, entries[6..]);
        WriteTriple(Vector.Zero, entries[9..]);
    }

    private static void WriteMap(in AffineMap map, Span<double> entries)
    {
        WriteTriple(map.Translation, entries);
        WriteTriple(map.Linear.V1, entries[3..]);
        WriteTriple(map.Linear.V2, entries[6..]);
        WriteTriple(map.Linear.V3, entries[9..]);
    }

    private delegate void EntryWriter<T>(in T item, Span<double> entries);

    private delegate T Composer<T>(in T m1, in T m2);

    private static void WriteTriple(Vector v, Span<double> entries)
    {
        entries[0] = v.X;
        entries[1] = v.Y;
        entries[2] = v.Z;
    }

    private static ReadOnlyMemory<T> Distinct<T>(T[] items, EntryWriter<T> write)
    {
        if (items.Length == 0)
        {
            return items;
        }

        Span<double> maxEntries = stackalloc double[EntryCount];
        Span<double> entries = stackalloc double[EntryCount];
        foreach (ref readonly var item in items.AsSpan())
        {
            write(item, entries);
            TakeLarger(maxEntries, entries);
        }

        ShareWithinTriples(maxEntries);
        var grid = new HashGrid<T>(write, maxEntries, items);
        foreach (ref readonly var item in items.AsSpan())
        {
            grid.Add(item);
        }

        return grid.Items;
    }

    private static void TakeLarger(Span<double> maxEntries, ReadOnlySpan<double> entries)
    {
        for (var i = 0; i < EntryCount; i++)
        {
            maxEntries[i] = Math.Max(maxEntries[i], Math.Abs(entries[i]));
        }
    }

    /// <summary>The entries of a triple are of one kind: lengths, angles, factors, or a column of a matrix.</summary>
    private static void ShareWithinTriples(Span<double> maxEntries)
    {
        for (var i = 0; i < EntryCount; i += 3)
        {
            maxEntries[i..(i + 3)].Fill(Math.Max(maxEntries[i], Math.Max(maxEntries[i + 1], maxEntries[i + 2])));
        }
    }

    /// <summary>A hash table over the cells of a grid in the space of all entries. It keeps items only, and no hashes of them.</summary>
    private ref struct HashGrid<T>
    {
        // The offset basis of the hash FNV-1a.
        private const ulong Seed = 14695981039346656037;

        private readonly EntryWriter<T> _write;
        private readonly ReadOnlySpan<double> _maxEntries;
        private readonly T[] _items;

        // The next item whose hash begins with the same bits, and the first one of each such chain; −1 for none.
        private readonly int[] _next;
        private readonly int[] _first;

        /// <summary>Makes a table without items, whose memory the caller lends.</summary>
        /// <param name="write">Writes the entries of an item.</param>
        /// <param name="maxEntries">The largest entry of each kind, in size.</param>
        /// <param name="items">Room for all distinct items, not empty. It may hold the items that will be added, in that order.</param>
        public HashGrid(EntryWriter<T> write, ReadOnlySpan<double> maxEntries, T[] items)
        {
            _write = write;
            _maxEntries = maxEntries;
            _items = items;
            _next = GC.AllocateUninitializedArray<int>(items.Length);
            _first = EmptyChains(items.Length);
        }

        /// <summary>Number of distinct items so far.</summary>
        public int Count { get; private set; }

        /// <summary>The distinct items, in the order in which they were added. Not copied.</summary>
        public readonly ReadOnlyMemory<T> Items => _items.AsMemory(0, Count);

        /// <summary>Adds an item for which there is room, unless an equal one was added before.</summary>
        public void Add(in T item)
        {
            Span<double> entries = stackalloc double[EntryCount];
            Span<double> other = stackalloc double[EntryCount];
            _write(item, entries);
            if (Contains(entries, 0, Seed, other))
            {
                return;
            }

            _items[Count] = item;
            Link(Count++, Hash(entries));
        }

        private static int[] EmptyChains(int capacity)
        {
            var first = GC.AllocateUninitializedArray<int>((int)BitOperations.RoundUpToPowerOf2((uint)capacity));
            first.AsSpan().Fill(-1);
            return first;
        }

        private readonly void Link(int index, ulong hash)
        {
            ref var first = ref ChainOf(hash);
            _next[index] = first;
            first = index;
        }

        // The high bits are mixed best.
        private readonly ref int ChainOf(ulong hash) => ref _first[(int)(hash >> 32) & (_first.Length - 1)];

        /// <summary>Computes the cell of an entry, and the entry's offset from the cell's centre, from −½ to ½ cells.</summary>
        private readonly (long Cell, double Offset) Quantize(double entry, int index)
        {
            var size = TolerancesPerCell * RelativeTolerance * _maxEntries[index];
            var position = size > 0 ? entry / size : 0;
            var cell = Math.Round(position);
            return ((long)cell, position - cell);
        }

        private static ulong CombineHash(ulong hash, long cell)
        {
            hash = (hash ^ (ulong)cell) * HashMixing.GoldenGamma;
            return hash ^ (hash >> 29);
        }

        private readonly ulong Hash(ReadOnlySpan<double> entries)
        {
            var hash = Seed;
            for (var i = 0; i < EntryCount; i++)
            {
                hash = CombineHash(hash, Quantize(entries[i], i).Cell);
            }

            return hash;
        }

        /// <summary>Searches for an equal item in the cell of the entries, and beyond the edges that they are close to.</summary>
        /// <param name="entries">Entries of the item.</param>
        /// <param name="index">Number of the entries that are in the hash already.</param>
        /// <param name="hash">Hash of the cells of these entries.</param>
        /// <param name="other">Memory for the entries of another item.</param>
        private readonly bool Contains(ReadOnlySpan<double> entries, int index, ulong hash, Span<double> other)
        {
            for (; index < EntryCount; index++)
            {
                var (cell, offset) = Quantize(entries[index], index);
                if (Math.Abs(offset) > 0.5 - (2.0 / TolerancesPerCell)
                    && Contains(entries, index + 1, CombineHash(hash, cell + Math.Sign(offset)), other))
                {
                    return true;
                }

                hash = CombineHash(hash, cell);
            }

            for (var candidate = ChainOf(hash); candidate >= 0; candidate = _next[candidate])
            {
                _write(_items[candidate], other);
                if (AreEqual(entries, other))
                {
                    return true;
                }
            }

            return false;
        }

        private readonly bool AreEqual(ReadOnlySpan<double> entries, ReadOnlySpan<double> other)
        {
            for (var i = 0; i < EntryCount; i++)
            {
                if (Math.Abs(entries[i] - other[i]) > RelativeTolerance * _maxEntries[i])
                {
                    return false;
                }
            }

            return true;
        }
    }
}
