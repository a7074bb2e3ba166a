using System.Runtime.InteropServices;
using FractalEngine.Core.Maths;

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
    public static AffineMap[] Deduplicate(AffineMap[] maps) => Distinct(maps, WriteMap);

    /// <summary>
    /// Keeps the first of each group of equal products m1·m2, in the order of <see cref="FractalGenerator.ConcatenatePair"/>: the same maps
    /// as those of <see cref="Deduplicate(AffineMap[])"/>, without an array of all pairs.
    /// </summary>
    /// <param name="outer">The maps m1.</param>
    /// <param name="inner">The maps m2.</param>
    /// <param name="maxCount">Maximum number of distinct products.</param>
    /// <returns>The distinct products; null if there are more.</returns>
    public static AffineMap[]? DeduplicateProducts(ReadOnlySpan<AffineMap> outer, ReadOnlySpan<AffineMap> inner, long maxCount) =>
        DistinctProducts(outer, inner, static (in AffineMap m1, in AffineMap m2) => m1 * m2, WriteMap, maxCount);

    /// <summary>
    /// Keeps the first of each group of equal componentwise compositions, without an array of all pairs: those of the first transformation
    /// with all sums, then those of the second, and so on.
    /// </summary>
    /// <param name="transformations">The transformations of one level.</param>
    /// <param name="sums">The sums so far.</param>
    /// <param name="maxCount">Maximum number of distinct sums.</param>
    /// <returns>The distinct sums; null if there are more.</returns>
    /// <remarks>Angles are compared as numbers, so 360° differs from 0°.</remarks>
    public static Transformation[]? DeduplicateSums(
        ReadOnlySpan<Transformation> transformations, ReadOnlySpan<Transformation> sums, long maxCount) => DistinctProducts(
            transformations, sums,
            static (in Transformation added, in Transformation sum) => Transformation.ComposeComponentwise(sum, added),
            WriteTransformation, maxCount);

    private static T[]? DistinctProducts<T>(
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
        var grid = new HashGrid<T>(write, maxEntries, Math.Max(outer.Length, inner.Length));
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

        return grid.ToArray();
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

    private static T[] Distinct<T>(T[] items, EntryWriter<T> write)
    {
        Span<double> maxEntries = stackalloc double[EntryCount];
        Span<double> entries = stackalloc double[EntryCount];
        foreach (ref readonly var item in items.AsSpan())
        {
            write(item, entries);
            TakeLarger(maxEntries, entries);
        }

        ShareWithinTriples(maxEntries);
        var grid = new HashGrid<T>(write, maxEntries, items.Length);
        foreach (ref readonly var item in items.AsSpan())
        {
            grid.Add(item);
        }

        return grid.Count == items.Length ? items : grid.ToArray();
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

    /// <summary>A hash table over the cells of a grid in the space of all entries.</summary>
    private readonly ref struct HashGrid<T>(EntryWriter<T> write, ReadOnlySpan<double> maxEntries, int capacity)
    {
        // The offset basis of the hash FNV-1a.
        private const ulong Seed = 14695981039346656037;

        private readonly ReadOnlySpan<double> _maxEntries = maxEntries;
        private readonly Dictionary<ulong, int> _firstOfCell = new(capacity);
        private readonly List<int> _nextOfCell = new(capacity);
        private readonly List<T> _distinct = new(capacity);

        /// <summary>Number of distinct items so far.</summary>
        public int Count => _distinct.Count;

        /// <summary>The distinct items, in the order in which they were added.</summary>
        public T[] ToArray() => [.. _distinct];

        /// <summary>Adds an item, unless an equal one was added before.</summary>
        public void Add(in T item)
        {
            Span<double> entries = stackalloc double[EntryCount];
            Span<double> other = stackalloc double[EntryCount];
            write(item, entries);
            if (!Contains(entries, 0, Seed, other))
            {
                ref var first = ref CollectionsMarshal.GetValueRefOrAddDefault(_firstOfCell, Hash(entries), out var exists);
                _nextOfCell.Add(exists ? first : -1);
                first = _distinct.Count;
                _distinct.Add(item);
            }
        }

        /// <summary>Computes the cell of an entry, and the entry's offset from the cell's centre, from −½ to ½ cells.</summary>
        private (long Cell, double Offset) Quantize(double entry, int index)
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

        private ulong Hash(ReadOnlySpan<double> entries)
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
        private bool Contains(ReadOnlySpan<double> entries, int index, ulong hash, Span<double> other)
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

            if (!_firstOfCell.TryGetValue(hash, out var candidate))
            {
                return false;
            }

            for (; candidate >= 0; candidate = _nextOfCell[candidate])
            {
                write(_distinct[candidate], other);
                if (AreEqual(entries, other))
                {
                    return true;
                }
            }

            return false;
        }

        private bool AreEqual(ReadOnlySpan<double> entries, ReadOnlySpan<double> other)
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
