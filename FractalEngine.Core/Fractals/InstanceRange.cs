using System.Numerics;
using FractalEngine.Core.Fractals.Levels;

namespace FractalEngine.Core.Fractals;

/// <summary>How many instances a fractal may have, and has, in which places decide what stands there: by chance, or by size.</summary>
/// <remarks>What has neither in it is counted as <see cref="DistinctInstances"/> does, and all else a way each.</remarks>
/// <param name="Least">A number that is never less: the fewest that choices allow. Null where there are too many places to tell.</param>
/// <param name="Expected">The mean over all seeds, rounded down, and about where something ends by its size.</param>
/// <param name="Most">A number that is never more: the most that choices allow.</param>
/// <param name="Exact">
/// The number, by enumeration of the different places: those of equal size and level are one where no choice depends on the way to them.
/// Null where there are too many.
/// </param>
public readonly record struct InstanceRange(BigInteger? Least, BigInteger? Expected, BigInteger? Most, BigInteger? Exact)
{
    // Of the expected number, and of probabilities.
    private const int FractionBits = 64;

    // Bounds are told at any rate, where they take some hundredths of a second.
    private const int MinRanges = 20_000;

    // A 64th of a factor of 2.
    private const long CoarsestUnit = 1L << 26;

    private static readonly BigInteger One = BigInteger.One << FractionBits;

    // The recursion takes some of the stack for each.
    private const int MaxLevels = 2000;

    /// <summary>Counts the instances of a fractal in affine composition that is finite.</summary>
    /// <param name="hierarchy">With a level for each set.</param>
    /// <param name="valueOfBase">What an instance of a base mesh counts.</param>
    /// <param name="maxStates">Number of different places up to which they are enumerated.</param>
    /// <param name="hasBounds">False where an exact number is enough: nothing is by chance, or nobody asks for more.</param>
    internal static InstanceRange Of(FractalHierarchy hierarchy, Func<int, BigInteger> valueOfBase, long maxStates, bool hasBounds)
    {
        var counter = new Counter(hierarchy, valueOfBase, maxStates, CoarsestUnit);
        var exact = counter.CountAt(hierarchy.Start, 0);
        if (!hasBounds && exact is not null)
        {
            return new(exact, exact, exact, exact);
        }

        var range = counter.RangeAt(hierarchy.Top.Level, default, 0);
        // Finer sizes give closer bounds, as long as there are not too many different ones.
        for (var unit = CoarsestUnit >> 4; hierarchy.DependsOnSizes && counter.RangeCount < maxStates / 8 && unit > 1; unit >>= 4)
        {
            counter = new(hierarchy, valueOfBase, maxStates, unit);
            range = counter.RangeAt(hierarchy.Top.Level, default, 0) ?? range;
        }

        return new(range?.Least, range?.Expected >> FractionBits, range?.Most, exact);
    }

    private sealed class Counter(FractalHierarchy hierarchy, Func<int, BigInteger> valueOfBase, long maxStates, long unit)
    {
        private readonly Dictionary<(long Level, SizeSpan Sizes), InstanceRange?> _ranges = [];
        private readonly Dictionary<LevelState, BigInteger?> _counts = [];

        /// <summary>Number of different levels and sizes that were met.</summary>
        public int RangeCount => _ranges.Count;

        /// <summary>
        /// The numbers of a level where the size lies within bounds, the expected one as a fixed-point number; null for too many places.
        /// </summary>
        public InstanceRange? RangeAt(long level, SizeSpan sizes, int depth)
        {
            if (hierarchy.IsBase(level))
            {
                var value = valueOfBase(hierarchy.AllLevels.At(level).BaseIndex);
                return new(value, value << FractionBits, value, value);
            }

            if (_ranges.TryGetValue((level, sizes), out var known) || _ranges.Count > Math.Max(maxStates, MinRanges) || depth > MaxLevels)
            {
                return known;
            }

            var pick = hierarchy.MapSetAt(level)?.Pick;
            var edges = hierarchy.AllLevels.At(level).Edges;
            if (pick is { IsFixed: true })
            {
                return _ranges[(level, sizes)] = PartOf(edges[pick.Select(new(level))]);
            }

            InstanceRange? range = pick is null ? new(0, 0, 0, 0) : new(null, 0, null, null);
            if (pick is { DependsOnSize: true })
            {
                var (first, last) = (pick.Select(new(level, 0, sizes.Low)), pick.Select(new(level, 0, sizes.High)));
                var likely = pick.Select(new(level, 0, sizes.Middle));
                range = first == last ? PartOf(edges[first])
                    : Either(Either(range, PartOf(edges[likely]), One), PartOf(edges[first + last - likely]), BigInteger.Zero);
            }
            else
            {
                foreach (var (i, edge) in edges.Index())
                {
                    range = pick?.ProbabilityOf(i) is not { } probability ? Both(range, PartOf(edge))
                        : probability.IsZero ? range
                        : Either(range, PartOf(edge), probability);
                }
            }

            return _ranges[(level, sizes)] = range;

            InstanceRange? PartOf(in ChildEdge edge) => RangeAt(
                edge.RemainingLevels(level),
                hierarchy.DependsOnSizes ? sizes.Under(edge.Set.SizeOf(edge.MapIndex), unit) : default,
                depth + 1);
        }

        private static InstanceRange? Both(InstanceRange? range, InstanceRange? part) => range is { } a && part is { } b
            ? new(a.Least + b.Least, a.Expected + b.Expected, a.Most + b.Most, a.Exact + b.Exact)
            : null;

        private static InstanceRange? Either(InstanceRange? range, InstanceRange? part, BigInteger probability) =>
            range is { } a && part is { } b
                ? new(
                    a.Least < b.Least ? a.Least : b.Least,
                    a.Expected + ((b.Expected * probability) >> FractionBits),
                    a.Most > b.Most ? a.Most : b.Most,
                    null)
                : null;

        /// <summary>Counts by enumeration, each place once; null where there are too many.</summary>
        public BigInteger? CountAt(LevelState state, int depth)
        {
            if (hierarchy.IsBase(state.Level))
            {
                return valueOfBase(hierarchy.AllLevels.At(state.Level).BaseIndex);
            }

            // Below what has no choices the way is of no account.
            if (!hierarchy.DependsOnSizes && RangeAt(state.Level, default, depth)?.Exact is { } known)
            {
                return known;
            }

            if (_counts.TryGetValue(state, out var count) || _counts.Count > maxStates || depth > MaxLevels)
            {
                return count;
            }

            count = BigInteger.Zero;
            foreach (var edge in hierarchy.AllLevels.At(state.Level).Edges)
            {
                count += CountAt(hierarchy.Resolve(edge.Enter(in state)), depth + 1);
                if (count is null)
                {
                    break;
                }
            }

            return _counts[state] = count;
        }
    }

    /// <summary>Bounds of a size, so coarse that many places have the same.</summary>
    private readonly record struct SizeSpan(long Low, long High)
    {
        public long Middle => Low + ((High - Low) / 2);

        /// <summary>The bounds of what is smaller by a size, in units that are powers of 2.</summary>
        public SizeSpan Under(long size, long unit) => new((Low + size) & -unit, -(-(High + size) & -unit));
    }
}
