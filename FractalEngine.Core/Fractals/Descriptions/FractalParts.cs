using System.Collections.Immutable;
using System.Numerics;

namespace FractalEngine.Core.Fractals.Descriptions;

/// <summary>Computes numbers of a whole from those of its parts, each once.</summary>
/// <param name="meshCount">Number of base meshes, which are the first parts.</param>
/// <param name="parts">The other parts; the last one is the whole.</param>
internal readonly struct FractalParts(int meshCount, ImmutableArray<FractalPart> parts)
{
    /// <summary>True when the whole has a part without end, or is made of one.</summary>
    public bool IsInfinite => Evaluate(
        static _ => false, static (part, isInfiniteAt) => part.IsInfinite || part.References.Any(isInfiniteAt));

    /// <summary>Number of sets that the longest chain of maps passes through; null for infinitely many.</summary>
    public long? LevelCount => Evaluate<long?>(static _ => 0, static (part, levelsAt) => part.CountLevels(levelsAt));

    /// <summary>Number of decimal digits of the number of chains, estimated at next to no cost; 0 for infinitely many.</summary>
    public double Digits => IsInfinite ? 0 : EstimateInstances().Digits;

    /// <summary>Counts the chains of maps that lead to a base mesh, equal ones counted; null for infinitely many.</summary>
    /// <remarks>Exact at any size: numbers of millions of digits take about a second.</remarks>
    public BigInteger? CountInstances(int mesh) => CountInstances(index => index == mesh ? BigInteger.One : BigInteger.Zero);

    /// <summary>Sums a number of the base meshes over all chains of maps; null for infinitely many.</summary>
    public BigInteger? CountInstances(Func<int, BigInteger> valueOfMesh) =>
        Evaluate<BigInteger?>(index => valueOfMesh(index), static (part, countAt) => part.CountInstances(countAt));

    /// <summary>Tells whether there are at most so many chains of maps, at next to no cost.</summary>
    /// <param name="limit">At most 2⁵³.</param>
    public bool HasAtMostInstances(long limit) => !IsInfinite
        && !parts.Any(static part => part is RecursivePart { Levels: null })
        && EstimateInstances() is { Scale: 0 } count && count.Mantissa <= limit;

    private ScaledCount EstimateInstances() =>
        Evaluate(static _ => new ScaledCount(1, 0), static (part, countAt) => part.EstimateInstances(countAt));

    private T Evaluate<T>(Func<int, T> valueOfMesh, Func<FractalPart, Func<int, T>, T> valueOfPart)
    {
        var values = Enumerable.Range(0, meshCount).Select(valueOfMesh).ToList();
        foreach (var part in parts)
        {
            values.Add(valueOfPart(part, index => values[index]));
        }

        return values[^1];
    }
}
