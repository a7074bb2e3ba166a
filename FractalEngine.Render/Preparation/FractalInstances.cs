using System.Collections.Immutable;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Maths;

namespace FractalEngine.Render.Preparation;

/// <summary>The instances of a fractal that a budget allows to draw, and what was left out.</summary>
/// <param name="Maps">From the base mesh's frame to the fractal's; none twice.</param>
/// <param name="Notice">A sentence for the user when the fractal is drawn at a smaller depth than it has; else null.</param>
internal sealed record FractalInstances(ImmutableArray<AffineMap> Maps, string? Notice)
{
    /// <summary>Expands a fractal as deep as the settings allow.</summary>
    /// <param name="name">The file's name, for the notice.</param>
    /// <param name="fractal">Any fractal, infinite ones too.</param>
    /// <param name="settings">Instance and triangle budget.</param>
    public static FractalInstances Expand(string name, Fractal fractal, RenderSettings settings)
    {
        var faces = fractal.BaseMesh.FaceCount;
        if (faces == 0)
        {
            return new([], null);
        }

        var budget = Math.Clamp(settings.TriangleBudget / faces, 1, Math.Max(1, settings.InstanceBudget));
        if (TryExpandComponentwise(fractal, budget) is { } componentwiseMaps)
        {
            return new(componentwiseMaps, null);
        }

        var truncated = fractal.WithMaxInstances(budget);
        return new(
            FractalGenerator.Expand(truncated, budget),
            ReferenceEquals(truncated, fractal) ? null : FormatNotice(name, fractal, truncated, budget));
    }

    /// <summary>
    /// Componentwise sums are far fewer than the chains that <see cref="Fractal.WithMaxInstances"/> counts, so the whole fractal is tried
    /// first.
    /// </summary>
    private static ImmutableArray<AffineMap>? TryExpandComponentwise(Fractal fractal, long budget)
    {
        if (fractal.Description.Composition != Composition.Componentwise)
        {
            return null;
        }

        try
        {
            return FractalGenerator.Expand(fractal, budget);
        }
        catch (FractalLimitException)
        {
            // The limit is the answer: the caller draws less and says so.
            return null;
        }
    }

    private static string FormatNotice(string name, Fractal fractal, Fractal truncated, long budget) =>
        $"{name}: {DecimalText.FormatApproximately(fractal.InstanceCount)} instances are more than the budget of {DecimalText.FormatApproximately(budget)}: drawn at {FormatDepth(fractal, truncated)}";

    /// <summary>In rounds where one repetition was cut short, else in levels.</summary>
    private static string FormatDepth(Fractal fractal, Fractal truncated)
    {
        var (fullSteps, truncatedSteps) = (fractal.Description.Steps, truncated.Description.Steps);
        if (fullSteps.Length == truncatedSteps.Length)
        {
            var changedSteps = Enumerable.Range(0, fullSteps.Length).Where(i => !ReferenceEquals(fullSteps[i], truncatedSteps[i]))
                .ToArray();
            if (changedSteps is [var changedStep]
                && (fullSteps[changedStep], truncatedSteps[changedStep]) is (Repetition { Count: var fullCount },
                Repetition { Count: var truncatedCount }))
            {
                return $"depth {DecimalText.FormatApproximately(truncatedCount)} of {DecimalText.FormatApproximately(fullCount)}";
            }
        }

        return $"{DecimalText.FormatApproximately(truncated.LevelCount)} of {DecimalText.FormatApproximately(fractal.LevelCount)} levels";
    }
}
