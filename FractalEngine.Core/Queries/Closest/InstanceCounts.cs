using FractalEngine.Core.Fractals.Levels;

namespace FractalEngine.Core.Queries.Closest;

/// <summary>
/// Sums a number of the base meshes, such as that of their faces, over the instances in a sub-fractal. What equal maps or the identity in a
/// set make many times over counts once, as in searches.
/// </summary>
/// <param name="hierarchy">The sub-fractals.</param>
/// <param name="valueOfBase">The number of the base mesh with an index, not negative.</param>
/// <param name="limit">Sums are no larger than this; at most 2⁶².</param>
/// <remarks>Each sub-fractal is counted once. Recursive, so for no more than some thousand levels.</remarks>
internal sealed class InstanceCounts(FractalHierarchy hierarchy, Func<int, long> valueOfBase, long limit)
{
    private readonly Dictionary<long, long> _sums = [];

    /// <summary>Sums over the instances in a sub-fractal that a search can visit.</summary>
    /// <param name="level">Its remaining levels.</param>
    public long SumAt(long level)
    {
        if (hierarchy.IsBase(level))
        {
            return Math.Min(valueOfBase(hierarchy.At(level).BaseIndex), limit);
        }

        if (!_sums.TryGetValue(level, out var sum))
        {
            foreach (var child in hierarchy.At(level).AllChildren())
            {
                sum = child.Group is null ? Math.Min(sum + SumAt(child.RemainingLevels(level)), limit) : sum;
            }

            _sums[level] = sum;
        }

        return sum;
    }
}
