using System.Numerics;
using FractalEngine.Core.Fractals.Levels;

namespace FractalEngine.Core.Fractals;

/// <summary>How many instances a fractal may have, and has, in which places decide what stands there: by chance, or by size.</summary>
/// <remarks>What has neither in it is counted as <see cref="DistinctInstances"/> does, and all else a way each.</remarks>
/// <param name="Least">The fewest that choices allow; null where something ends by its size.</param>
/// <param name="Expected">The mean over all seeds, rounded down; null where something ends by its size.</param>
/// <param name="Most">The most that choices allow; null where something ends by its size.</param>
/// <param name="Exact">
/// The number, by enumeration of the different places: those of equal size and level are one where no choice depends on the way to them.
/// Null where there are too many.
/// </param>
public readonly record struct InstanceRange(BigInteger? Least, BigInteger? Expected, BigInteger? Most, BigInteger? Exact)
{
    // Of the expected number, and of probabilities.
    private const int FractionBits = 64;

    // The recursion takes some of the stack for each.
    private const int MaxLevels = 2000;

    /// <summary>Counts the instances of a fractal in affine composition that is finite.</summary>
    /// <param name="hierarchy">With a level for each set.</param>
    /// <param name="valueOfBase">What an instance of a base mesh counts.</param>
    /// <param name="maxStates">Number of different places up to which they are enumerated.</param>
    internal static InstanceRange Of(FractalHierarchy hierarchy, Func<int, BigInteger> valueOfBase, long maxStates)
    {
        var counter = new Counter(hierarchy, valueOfBase, maxStates);
        var exact = counter.CountAt(hierarchy.Start, 0);
        if (hierarchy.DependsOnSizes)
        {
            return new(null, null, null, exact);
        }

        var range = counter.RangeAt(hierarchy.Top.Level);
        return range with { Expected = range.Expected >> FractionBits, Exact = exact };
    }

    private sealed class Counter(FractalHierarchy hierarchy, Func<int, BigInteger> valueOfBase, long maxStates)
    {
        private readonly Dictionary<long, InstanceRange> _ranges = [];
        private readonly Dictionary<LevelState, BigInteger?> _counts = [];

        /// <summary>The numbers of a level; the expected one as a fixed-point number.</summary>
        public InstanceRange RangeAt(long level)
        {
            if (hierarchy.IsBase(level))
            {
                var value = valueOfBase(hierarchy.AllLevels.At(level).BaseIndex);
                return new(value, value << FractionBits, value, value);
            }

            if (_ranges.TryGetValue(level, out var range))
            {
                return range;
            }

            var pick = hierarchy.MapSetAt(level)?.Pick;
            range = pick is null ? new(0, 0, 0, 0) : new(null, 0, null, null);
            foreach (var (i, edge) in hierarchy.AllLevels.At(level).Edges.Index())
            {
                var part = RangeAt(edge.RemainingLevels(level));
                var probability = pick?.ProbabilityOf(i);
                range = probability is null
                    ? new(range.Least + part.Least, range.Expected + part.Expected, range.Most + part.Most, range.Exact + part.Exact)
                    : probability.Value.IsZero ? range
                    : new(
                        range.Least < part.Least ? range.Least : part.Least,
                        range.Expected + ((part.Expected * probability) >> FractionBits),
                        range.Most > part.Most ? range.Most : part.Most,
                        null);
            }

            return _ranges[level] = range;
        }

        /// <summary>Counts by enumeration, each place once; null where there are too many.</summary>
        public BigInteger? CountAt(LevelState state, int depth)
        {
            if (hierarchy.IsBase(state.Level))
            {
                return valueOfBase(hierarchy.AllLevels.At(state.Level).BaseIndex);
            }

            // Below what has no choices the way is of no account.
            if (!hierarchy.DependsOnSizes && RangeAt(state.Level).Exact is { } known)
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
}
