using System.Collections.Immutable;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Fractals.Descriptions;

/// <summary>
/// The similarity dimension of what a repetition tends to (Moran 1946, Hutchinson 1981): the number s with Σ rˢ = 1 over the ratios r of
/// all chains of one round.
/// </summary>
/// <remarks>
/// It is the Hausdorff dimension where the child instances hardly overlap, and an upper bound else. The ratio of a map that is no
/// similarity is the cube root of its determinant. A chain of identities alone, which keeps a round beside its child instances, does not
/// count: it adds the base again, but nothing to the limit.
/// </remarks>
public static class SimilarityDimension
{
    // A double has no more places.
    private const int BisectionCount = 60;
    private const double MaxDimension = 1e6;

    // Roots of determinants are rounded: a chain this close to 1 does not shrink.
    private const double MaxRatio = 1 - 1e-12;

    /// <summary>Computes the dimension of a fractal, as if its repetitions had no end.</summary>
    /// <param name="fractal">Its steps; the repetition of the largest dimension counts.</param>
    /// <returns>
    /// At least 0. Null where nothing is repeated, where a chain does not shrink, for recursives of several calls, and for componentwise
    /// composition, whose chains are no products of maps.
    /// </returns>
    /// <remarks>Cost: some dozen passes over the different ratios.</remarks>
    public static double? Of(FractalDescription fractal)
    {
        ArgumentNullException.ThrowIfNull(fractal);
        if (fractal.Parts.Any(static part => part.HasDepth))
        {
            return null;
        }

        double? largest = null;
        foreach (var repetition in fractal.Steps.OfType<Repetition>())
        {
            if (fractal.Composition == Composition.Componentwise || Solve(repetition) is not { } dimension)
            {
                return null;
            }

            largest = Math.Max(largest ?? 0, dimension);
        }

        return largest;
    }

    private static double? Solve(Repetition repetition)
    {
        var levels = new List<Level>();
        AddLevels(levels, repetition.Round, 1);
        var largestRatio = levels.Aggregate(
            1.0, static (product, level) => product * Math.Pow(Math.Max(level.LargestRatio, level.IdentityCount > 0 ? 1 : 0), level.Count));
        var hasIdentities = levels.TrueForAll(static level => level.IdentityCount > 0);
        if (hasIdentities ? levels.Exists(static level => level.LargestRatio > MaxRatio) : !(largestRatio <= MaxRatio))
        {
            return null;
        }

        var (low, high) = (0.0, 1.0);
        if (Excess(levels, 0) <= 0)
        {
            return 0;
        }

        while (Excess(levels, high) > 0)
        {
            (low, high) = (high, 2 * high);
            if (high > MaxDimension)
            {
                return null;
            }
        }

        for (var i = 0; i < BisectionCount; i++)
        {
            var middle = 0.5 * (low + high);
            (low, high) = Excess(levels, middle) > 0 ? (middle, high) : (low, middle);
        }

        return 0.5 * (low + high);
    }

    /// <summary>Returns Σ rˢ − 1 over all chains but those of identities alone.</summary>
    private static double Excess(List<Level> levels, double dimension)
    {
        var sum = 1.0;
        var identities = 1.0;
        foreach (var level in levels)
        {
            sum *= Math.Pow(level.IdentityCount + level.Ratios.Sum(item => item.Count * Math.Pow(item.Ratio, dimension)), level.Count);
            identities *= Math.Pow(level.IdentityCount, level.Count);
        }

        return sum - identities - 1;
    }

    private static void AddLevels(List<Level> levels, ImmutableArray<FractalStep> body, double count)
    {
        foreach (var step in body)
        {
            if (step is Repetition { Count: var repeated } nested)
            {
                AddLevels(levels, nested.Round, count * (repeated ?? 1));
            }
            else if (step is TransformationSet set)
            {
                var ratios = set.Maps.Where(static map => map != AffineMap.Identity)
                    .GroupBy(static map => Math.Cbrt(Math.Abs(map.Linear.Determinant())))
                    .Select(static group => (group.Key, group.Count())).ToImmutableArray();
                levels.Add(new(ratios, set.Maps.Count(static map => map == AffineMap.Identity), count));
            }
        }
    }

    /// <summary>What one level of a round contributes to the equation of the dimension.</summary>
    /// <param name="Ratios">Different ratios, and how many maps have each.</param>
    /// <param name="IdentityCount">Number of maps that change nothing.</param>
    /// <param name="Count">How often the level occurs in a round.</param>
    private sealed record Level(ImmutableArray<(double Ratio, int Count)> Ratios, int IdentityCount, double Count)
    {
        /// <summary>The largest ratio of a map that changes something; 0 where there is none.</summary>
        public double LargestRatio => Ratios.IsEmpty ? 0 : Ratios.Max(static item => item.Ratio);
    }
}
