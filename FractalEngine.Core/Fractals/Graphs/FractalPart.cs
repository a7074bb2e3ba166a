using System.Collections.Immutable;
using System.Numerics;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Fractals.Graphs;

/// <summary>
/// A part of a <see cref="FractalGraph"/>, made of earlier parts: a <see cref="SteppedPart"/> or a <see cref="RecursivePart"/>.
/// </summary>
internal abstract class FractalPart
{
    /// <summary>True when the part itself goes on without end.</summary>
    public abstract bool IsInfinite { get; }

    /// <summary>True for a sum, which applies nothing to its terms, so that they may be infinite.</summary>
    public abstract bool IsSum { get; }

    /// <summary>Indices of the earlier parts that the part is made of.</summary>
    public abstract IEnumerable<int> References { get; }

    /// <summary>The maps of the part, by sets.</summary>
    public abstract IEnumerable<ImmutableArray<AffineMap>> MapSets { get; }

    /// <summary>Counts the chains of maps that lead to a base mesh; null for infinitely many.</summary>
    /// <param name="countAt">Gives the number of an earlier part.</param>
    public abstract BigInteger? CountInstances(Func<int, BigInteger?> countAt);

    /// <summary>Estimates the number of chains of a finite part at next to no cost; it is exact up to 2⁵³.</summary>
    /// <param name="countAt">Gives the number of an earlier part.</param>
    public abstract ScaledCount EstimateInstances(Func<int, ScaledCount> countAt);
}
