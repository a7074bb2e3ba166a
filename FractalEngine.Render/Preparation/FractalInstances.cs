using System.Collections.Immutable;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Maths;
using FractalEngine.Render.Views;

namespace FractalEngine.Render.Preparation;

/// <summary>The instances of a fractal that a budget allows, with a notice about those that it does not.</summary>
/// <param name="Maps">Maps from the base mesh's frame to the fractal's, each once.</param>
/// <param name="Tints">For each what maps mix into its colour; none where no map has a colour.</param>
/// <param name="Notice">A sentence for the user if the fractal is drawn at a smaller depth than its own; otherwise null.</param>
internal sealed record FractalInstances(ImmutableArray<AffineMap> Maps, ImmutableArray<Tint> Tints, string? Notice)
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
            return new([], [], null);
        }

        var budget = Math.Clamp(settings.TriangleBudget / faceCount, 1, Math.Max(1, settings.InstanceBudget));
        if (TryExpandWhole(fractal, budget) is var (allMaps, allTints))
        {
            return new(allMaps, allTints, null);
        }

        var truncated = fractal.WithMaxInstances(budget);
        var (maps, tints) = truncated.ExpandTinted(budget);
        return new(
            maps, tints,
            ReferenceEquals(truncated, fractal) ? null : FormatNotice(name, fractal, truncated, budget));
    }

    /// <summary>
    /// Expands a whole fractal of componentwise sums, or whose ways count; null for others and where there are too many. They are far fewer
    /// than the chains that <see cref="Fractal.WithMaxInstances"/> counts.
    /// </summary>
    private static (ImmutableArray<AffineMap> Maps, ImmutableArray<Tint> Tints)? TryExpandWhole(Fractal fractal, long budget)
    {
        if (fractal.Description.Composition != Composition.Componentwise && !fractal.Description.CountsWays)
        {
            return null;
        }

        try
        {
            return fractal.ExpandTinted(budget);
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
