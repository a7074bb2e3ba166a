using System.Collections.Immutable;
using System.Numerics;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Fractals.Descriptions;

/// <summary>
/// A part of a <see cref="FractalDescription"/>, made of earlier parts: a <see cref="SteppedPart"/> or a <see cref="RecursivePart"/>.
/// </summary>
public abstract class FractalPart : IEquatable<FractalPart>
{
    private protected FractalPart()
    {
    }

    /// <summary>True when the part itself goes on without end.</summary>
    public abstract bool IsInfinite { get; }

    /// <summary>True where nothing is repeated, so that what the part is made of may be infinite.</summary>
    public abstract bool MayHoldInfinite { get; }

    /// <summary>True for a part that has a depth, which can be changed.</summary>
    public abstract bool HasDepth { get; }

    /// <summary>Indices of the earlier parts that the part is made of.</summary>
    public abstract IEnumerable<int> References { get; }

    /// <summary>The maps of the part, by sets.</summary>
    internal abstract IEnumerable<ImmutableArray<AffineMap>> MapSets { get; }

    /// <summary>Counts the chains of maps that lead to a base mesh; null for infinitely many.</summary>
    /// <param name="countAt">Gives the number of an earlier part.</param>
    internal abstract BigInteger? CountInstances(Func<int, BigInteger?> countAt);

    /// <summary>Estimates the number of chains of a finite part at next to no cost; it is exact up to 2⁵³.</summary>
    /// <param name="countAt">Gives the number of an earlier part.</param>
    internal abstract ScaledCount EstimateInstances(Func<int, ScaledCount> countAt);

    /// <summary>Counts the sets that the longest chain of maps passes through; null for infinitely many.</summary>
    /// <param name="levelsAt">Gives the number of an earlier part.</param>
    internal abstract long? CountLevels(Func<int, long?> levelsAt);

    /// <summary>Makes the same part with its outermost repetition carried out so often.</summary>
    internal abstract FractalPart WithDepth(int depth);

    /// <summary>Makes the same part with everything repeated at most so often.</summary>
    internal abstract FractalPart WithMaxDepth(int depth);

    /// <summary>Makes the same part of other earlier parts.</summary>
    /// <param name="indexOf">Gives the new index of an earlier part.</param>
    internal abstract FractalPart WithReferences(Func<int, int> indexOf);

    /// <summary>Tells whether the other part does the same with the same earlier parts.</summary>
    public abstract bool Equals(FractalPart? other);

    /// <inheritdoc/>
    public sealed override bool Equals(object? obj) => Equals(obj as FractalPart);

    /// <inheritdoc/>
    public abstract override int GetHashCode();
}
