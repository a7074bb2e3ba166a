using System.Numerics;

namespace FractalEngine.Core.Fractals.Levels;

/// <summary>
/// Sums a number of the base meshes, such as that of their faces, over the instances in a sub-fractal. What equal maps or the identity in a
/// set make many times over counts once, as in searches.
/// </summary>
/// <param name="hierarchy">The sub-fractals.</param>
/// <param name="valueOfBase">The number of the base mesh with an index, not negative.</param>
/// <remarks>Each sub-fractal is counted once. Recursive, so for no more than some thousand levels.</remarks>
internal sealed class InstanceCounts(FractalHierarchy hierarchy, Func<int, long> valueOfBase)
{
    private readonly Dictionary<long, BigInteger> _sums = [];

    /// <summary>Sums over the instances in a sub-fractal that a search can visit.</summary>
    /// <param name="level">Its remaining levels.</param>
    public BigInteger SumAt(long level)
    {
        if (hierarchy.IsBase(level))
        {
            return valueOfBase(hierarchy.At(level).BaseIndex);
        }

        if (!_sums.TryGetValue(level, out var sum))
        {
            foreach (var child in hierarchy.At(level).AllChildren())
            {
                sum += child.Group is null ? SumAt(child.RemainingLevels(level)) : BigInteger.Zero;
            }

            _sums[level] = sum;
        }

        return sum;
    }
}
