using System.Collections.Immutable;
using System.Numerics;

namespace FractalEngine.Core.Fractals.Descriptions;

/// <summary>Counts and look-ups over a sequence of steps, outermost first.</summary>
public static class FractalSteps
{
    /// <summary>
    /// Counts the sets that a chain passes through; null stands for infinitely many. A number beyond that of a <see cref="long"/> is its
    /// maximum.
    /// </summary>
    public static long? LevelCount(ImmutableArray<FractalStep> steps) =>
        steps.Aggregate((long?)0, static (sum, step) => (sum, step.LevelCount) is ({ } total, { } count)
            ? (long)Int128.Min(long.MaxValue, (Int128)total + count)
            : null);

    /// <summary>Counts the chains of transformations, repeated ones too; null stands for infinitely many.</summary>
    public static BigInteger? InstanceCount(ImmutableArray<FractalStep> steps) =>
        steps.Any(step => step.InstanceCount is { IsZero: true }) ? BigInteger.Zero
        : steps.Aggregate((BigInteger?)BigInteger.One, (product, step) => product * step.InstanceCount);

    /// <summary>Estimates the number of decimal digits of the number of chains, at next to no cost; 0 for infinitely many.</summary>
    public static double EstimateDigits(ImmutableArray<FractalStep> steps) => steps.Sum(EstimateDigits);

    private static double EstimateDigits(FractalStep step) => step switch
    {
        Repetition { Count: { } count } repetition => count * EstimateDigits(repetition.Round),
        TransformationSet { Maps.Length: > 0 and var length } => Math.Log10(length),
        _ => 0,
    };

    /// <summary>Tells whether there are at most <paramref name="limit"/> chains of transformations.</summary>
    /// <remarks>This costs next to nothing, unlike the exact number, which may have millions of digits.</remarks>
    public static bool HasAtMostInstances(ImmutableArray<FractalStep> steps, long limit) => CountUpTo(steps, limit) <= limit;

    /// <summary>Counts the chains of transformations up to a limit; the result is above the limit if there are more.</summary>
    internal static BigInteger CountUpTo(ImmutableArray<FractalStep> steps, long limit)
    {
        var product = BigInteger.One;
        foreach (var step in steps)
        {
            // A set without maps at any step makes the product zero, so the loop may not end at the limit.
            product *= step.CountUpTo(limit);
            product = BigInteger.Min(product, new BigInteger(limit) + 1);
        }

        return product;
    }

    /// <summary>Makes the same steps with the outermost repetition carried out so often; the same ones without any.</summary>
    internal static ImmutableArray<FractalStep> WithDepth(this ImmutableArray<FractalStep> steps, int depth) =>
        steps.FirstOrDefault(static step => step is Repetition) is Repetition outermost
            ? steps.Replace(outermost, outermost.WithCount(depth))
            : steps;

    /// <summary>Makes the same steps with all repetitions carried out at most so often.</summary>
    internal static ImmutableArray<FractalStep> WithMaxDepth(this ImmutableArray<FractalStep> steps, int depth) =>
        ImmutableArray.CreateRange(
            steps, step => step is Repetition repetition && !(repetition.Count <= depth) ? repetition.WithCount(depth) : step);

    /// <summary>Finds the set at one level, in O(steps) whatever the number of rounds.</summary>
    /// <param name="steps">Steps, outermost first.</param>
    /// <param name="level">Level from 0, the outermost.</param>
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
