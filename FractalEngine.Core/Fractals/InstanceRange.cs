using System.Numerics;
using FractalEngine.Core.Fractals.Levels;

namespace FractalEngine.Core.Fractals;

/// <summary>How many instances a fractal by chance may have, and has.</summary>
/// <remarks>What has no choice in it is counted as <see cref="DistinctInstances"/> does, and all else a way each.</remarks>
/// <param name="Least">The fewest that choices allow.</param>
/// <param name="Expected">The mean over all seeds, rounded down.</param>
/// <param name="Most">The most that choices allow.</param>
/// <param name="Exact">The number; null where there are too many to enumerate.</param>
public readonly record struct InstanceRange(BigInteger Least, BigInteger Expected, BigInteger Most, BigInteger? Exact)
{
    // Of the expected number, and of probabilities.
    private const int FractionBits = 64;

    /// <summary>Counts the instances of a fractal.</summary>
    /// <param name="fractal">In affine composition, finite, and of no more than some thousand levels.</param>
    /// <param name="maxStates">Number of different places up to which they are enumerated.</param>
    /// <exception cref="Descriptions.FractalLimitException">The bounds of some level overflow a double, or don't converge.</exception>
    internal static InstanceRange Of(Fractal fractal, long maxStates)
    {
        var hierarchy = fractal.HierarchyBySets;
        var counter = new Counter(hierarchy, index => fractal.CountsMesh(index) ? BigInteger.One : BigInteger.Zero, maxStates);
        return counter.RangeAt(hierarchy.Top.Level) is var (least, expected, most, _)
            ? new(least, expected >> FractionBits, most, counter.CountAt(hierarchy.Start)) : default;
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

            var edges = hierarchy.AllLevels.At(level).Edges;
            var pick = hierarchy.MapSetAt(level)?.Pick;
            var parts = edges.Select(edge => RangeAt(edge.RemainingLevels(level))).ToArray();
            range = pick is null
                ? parts.Aggregate(new InstanceRange(0, 0, 0, BigInteger.Zero), static (sum, part) => new(
                    sum.Least + part.Least, sum.Expected + part.Expected, sum.Most + part.Most, sum.Exact + part.Exact))
                : new(
                    parts.Where((_, i) => pick.ProbabilityOf(i) > 0).Min(static part => part.Least),
                    parts.Select((part, i) => (part.Expected * pick.ProbabilityOf(i)) >> FractionBits)
                        .Aggregate(BigInteger.Zero, static (sum, part) => sum + part),
                    parts.Where((_, i) => pick.ProbabilityOf(i) > 0).Max(static part => part.Most),
                    null);
            return _ranges[level] = range;
        }

        /// <summary>Counts by enumeration, each place once; null where there are too many.</summary>
        public BigInteger? CountAt(LevelState state)
        {
            // Below what has no choices the way is of no account.
            if (RangeAt(state.Level).Exact is { } known)
            {
                return known;
            }

            state = hierarchy.DependsOnWays ? state : state with { Way = 0 };
            if (_counts.TryGetValue(state, out var count) || _counts.Count > maxStates)
            {
                return count;
            }

            count = BigInteger.Zero;
            foreach (var edge in hierarchy.AllLevels.At(state.Level).Edges)
            {
                count += CountAt(hierarchy.Resolve(edge.Enter(in state)));
                if (count is null)
                {
                    break;
                }
            }

            return _counts[state] = count;
        }
    }
}
