using System.Collections.Immutable;
using System.Numerics;

namespace FractalEngine.Core.Fractals.Descriptions;

/// <summary>
/// A step in the construction of a fractal, read outermost first: either one set of transformations
/// (<see cref="TransformationSet"/>) or a sequence of steps that is repeated (<see cref="Repetition"/>).
/// </summary>
public abstract class FractalStep : IEquatable<FractalStep>
{
    private protected FractalStep()
    {
    }

    /// <summary>Number of sets that a chain passes through in this step; null for infinitely many.</summary>
    public abstract long? LevelCount { get; }

    /// <summary>Number of chains of transformations in this step; null for infinitely many.</summary>
    public abstract BigInteger? InstanceCount { get; }

    /// <summary>Number of repetitions inside each other, this one included.</summary>
    public abstract int NestingDepth { get; }

    /// <summary>The sets of this step, each once for each place where it stands; outermost first.</summary>
    internal abstract IEnumerable<TransformationSet> Sets { get; }

    /// <summary>Finds the set at one level of this step.</summary>
    /// <param name="level">From 0, the outermost; less than <see cref="LevelCount"/>.</param>
    public abstract TransformationSet LevelAt(long level);

    /// <summary>Counts chains exactly up to a limit; a larger result only says that there are more.</summary>
    internal abstract BigInteger CountUpTo(long limit);

    /// <summary>Tells whether the other step has equal transformations in the same order and is repeated as often.</summary>
    public abstract bool Equals(FractalStep? other);

    /// <inheritdoc/>
    public sealed override bool Equals(object? obj) => Equals(obj as FractalStep);

    /// <inheritdoc/>
    public abstract override int GetHashCode();

    /// <summary>Combines the hashes of all steps: texts of many steps that differ in the last only take no longer than others.</summary>
    internal static int HashOf(ImmutableArray<FractalStep> steps) =>
        steps.Aggregate(steps.Length, static (hash, step) => HashCode.Combine(hash, step));
}
