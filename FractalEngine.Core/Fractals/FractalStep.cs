using System.Numerics;

namespace FractalEngine.Core.Fractals;

/// <summary>
/// A step in the construction of a fractal, read outermost first: either one set of transformations
/// (<see cref="TransformationSet"/>) or a sequence of steps that is repeated (<see cref="Repetition"/>).
/// </summary>
public abstract class FractalStep
{
    private protected FractalStep()
    {
    }

    /// <summary>How many sets a chain passes through in this step; null when they are infinitely many.</summary>
    public abstract long? LevelCount { get; }

    /// <summary>How many chains of transformations there are in this step; null when they are infinitely many.</summary>
    public abstract BigInteger? InstanceCount { get; }

    /// <summary>How many repetitions stand inside each other, this one included.</summary>
    public abstract int NestingDepth { get; }

    /// <summary>The set at one level of this step.</summary>
    /// <param name="level">From 0, the outermost; less than <see cref="LevelCount"/>.</param>
    public abstract TransformationSet LevelAt(long level);

    /// <summary>The number of chains, or, if they are more, some number above the limit.</summary>
    internal abstract BigInteger CountUpTo(long limit);
}
