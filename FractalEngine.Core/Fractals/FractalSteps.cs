using System.Collections.Immutable;
using System.Numerics;

namespace FractalEngine.Core.Fractals;

/// <summary>Sums and look-ups over a sequence of steps, outermost first.</summary>
public static class FractalSteps
{
    /// <summary>How many sets a chain passes through; null when they are infinitely many.</summary>
    public static long? LevelCount(ImmutableArray<FractalStep> steps) =>
        steps.Aggregate((long?)0, (sum, step) => sum + step.LevelCount);

    /// <summary>How many chains of transformations there are, repeated ones counted; null for infinitely many.</summary>
    public static BigInteger? InstanceCount(ImmutableArray<FractalStep> steps) =>
        steps.Any(step => step.InstanceCount is { IsZero: true }) ? BigInteger.Zero
        : steps.Aggregate((BigInteger?)BigInteger.One, (product, step) => product * step.InstanceCount);

    /// <summary>
    /// True when there are at most <paramref name="limit"/> chains. Unlike the exact count, which may have millions of digits, this
    /// costs next to nothing.
    /// </summary>
    public static bool HasAtMostInstances(ImmutableArray<FractalStep> steps, long limit) => CountUpTo(steps, limit) <= limit;

    /// <summary>How many chains there are, or, if they are more, some number above the limit.</summary>
    internal static BigInteger CountUpTo(ImmutableArray<FractalStep> steps, long limit)
    {
        var product = BigInteger.One;
        foreach (var step in steps)
        {
            // A set without maps anywhere leaves nothing, so the product may not be given up before the last step.
            product *= step.CountUpTo(limit);
            product = BigInteger.Min(product, new BigInteger(limit) + 1);
        }

        return product;
    }

    /// <summary>The set at one level. Cost O(steps), whatever the number of rounds.</summary>
    /// <param name="steps">Outermost first.</param>
    /// <param name="level">From 0, the outermost.</param>
    /// <exception cref="ArgumentOutOfRangeException">There is no such level.</exception>
    public static TransformationSet LevelAt(ImmutableArray<FractalStep> steps, long level)
    {
        ArgumentOutOfRangeException.ThrowIfNegative(level);
        var remainingLevel = level;
        foreach (var step in steps)
        {
            if (step.LevelCount is not { } count || remainingLevel < count)
            {
                return step.LevelAt(remainingLevel);
            }

            remainingLevel -= count;
        }

        throw new ArgumentOutOfRangeException(nameof(level), level, "the fractal has fewer levels");
    }
}
