using System.Collections.Immutable;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Maths;
using FractalEngine.Render.Views;

namespace FractalEngine.Render.Preparation;

/// <summary>The instances of a fractal that a budget allows, with a notice about those that it does not.</summary>
/// <param name="Maps">Maps from the base mesh's frame to the fractal's, each once.</param>
/// <param name="Notice">A sentence for the user if the fractal is drawn at a smaller depth than its own; otherwise null.</param>
internal sealed record FractalInstances(ImmutableArray<AffineMap> Maps, string? Notice)
{
    /// <summary>Expands a fractal as deep as the settings allow.</summary>
    /// <param name="name">Name of the file, for the notice.</param>
    /// <param name="fractal">Fractal of any depth, also infinite.</param>
    /// <param name="settings">Settings with the instance and triangle budgets.</param>
    public static FractalInstances Expand(string name, Fractal fractal, RenderSettings settings)
    {
        var faceCount = fractal.BaseMesh.FaceCount;
        if (faceCount == 0 || FractalSteps.HasAtMostInstances(fractal.Description.Steps, 0))
        {
            return new([], null);
        }

        var budget = Math.Clamp(settings.TriangleBudget / faceCount, 1, Math.Max(1, settings.InstanceBudget));
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
    /// Expands a whole fractal of componentwise sums; null for others and where there are too many. The sums are far fewer than the chains
    /// that <see cref="Fractal.WithMaxInstances"/> counts.
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
            // Exceeding the budget is a normal result: the caller then draws a smaller depth, with a notice.
            return null;
        }
    }

    private static string FormatNotice(string name, Fractal fractal, Fractal truncated, long budget)
    {
        var instances = DecimalText.FormatApproximately(fractal.InstanceCount);
        var limit = DecimalText.FormatApproximately(budget);
        return $"{name}: {instances} instances are more than the budget of {limit}: drawn at {FormatDepth(fractal, truncated)}";
    }

    /// <summary>Describes the drawn depth: in rounds where exactly one repetition was truncated, otherwise in levels.</summary>
    private static string FormatDepth(Fractal fractal, Fractal truncated)
    {
        var fullSteps = fractal.Description.Steps;
        var truncatedSteps = truncated.Description.Steps;
        if (fullSteps.Length == truncatedSteps.Length)
        {
            int[] changedSteps =
                [.. Enumerable.Range(0, fullSteps.Length).Where(i => !ReferenceEquals(fullSteps[i], truncatedSteps[i]))];
            if (changedSteps is [var step]
                && fullSteps[step] is Repetition { Count: var fullCount }
                && truncatedSteps[step] is Repetition { Count: var truncatedCount })
            {
                return $"depth {DecimalText.FormatApproximately(truncatedCount)} of {DecimalText.FormatApproximately(fullCount)}";
            }
        }

        return $"{DecimalText.FormatApproximately(truncated.LevelCount)} of {DecimalText.FormatApproximately(fractal.LevelCount)} levels";
    }
}
