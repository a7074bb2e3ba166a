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
    public static FractalInstances Of(string name, Fractal fractal, RenderSettings settings)
    {
        var faces = fractal.BaseMesh.FaceCount;
        if (faces == 0)
        {
            return new([], null);
        }

        var budget = Math.Clamp(settings.TriangleBudget / faces, 1, Math.Max(1, settings.InstanceBudget));
        if (TryExpandComponentwise(fractal, budget) is { } sums)
        {
            return new(sums, null);
        }

        var within = fractal.Within(budget);
        return new(
            FractalGenerator.Expand(within, budget),
            ReferenceEquals(within, fractal) ? null : NoticeOf(name, fractal, within, budget));
    }

    /// <summary>
    /// Componentwise sums are far fewer than the chains that <see cref="Fractal.Within"/> counts, so the whole fractal is tried first.
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

    private static string NoticeOf(string name, Fractal fractal, Fractal within, long budget) =>
        $"{name}: {DecimalText.Approximate(fractal.InstanceCount)} instances are more than the budget of {DecimalText.Approximate(budget)}: drawn at {Depth(fractal, within)}";

    /// <summary>In rounds where one repetition was cut short, else in levels.</summary>
    private static string Depth(Fractal fractal, Fractal within)
    {
        var (before, after) = (fractal.Description.Steps, within.Description.Steps);
        if (before.Length == after.Length)
        {
            var changed = Enumerable.Range(0, before.Length).Where(i => !ReferenceEquals(before[i], after[i])).ToArray();
            if (changed is [var only] && (before[only], after[only]) is (Repetition { Count: var whole }, Repetition { Count: var part }))
            {
                return $"depth {DecimalText.Approximate(part)} of {DecimalText.Approximate(whole)}";
            }
        }

        return $"{DecimalText.Approximate(within.LevelCount)} of {DecimalText.Approximate(fractal.LevelCount)} levels";
    }
}
