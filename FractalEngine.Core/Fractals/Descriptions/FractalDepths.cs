using System.Collections.Immutable;

namespace FractalEngine.Core.Fractals.Descriptions;

/// <summary>Finds how deep fractals of a limited number of instances are.</summary>
internal static class FractalDepths
{
    /// <summary>Cuts a description to the deepest one with a number of instances, see <see cref="Fractal.WithMaxInstances"/>.</summary>
    /// <returns>The description itself where it has no more; null where none is left.</returns>
    public static FractalDescription? Cut(FractalDescription description, long maxInstances)
    {
        if (Fits(description, maxInstances))
        {
            return description;
        }

        if (!description.Parts.IsEmpty)
        {
            return CutParts(description, maxInstances);
        }

        var steps = description.Steps;
        for (var i = 0; i < steps.Length && !Fits(new(steps), maxInstances); i++)
        {
            if (steps[i] is Repetition repetition)
            {
                steps = steps.SetItem(i, repetition.WithCount(MaxRepetitionCount(steps, i, repetition, maxInstances)));
            }
        }

        while (!Fits(new(steps), maxInstances))
        {
            steps = steps.RemoveAt(steps.Length - 1);
        }

        return description with { Steps = steps };
    }

    /// <summary>Cuts what is repeated in steps and parts to the greatest common depth with which the whole fits.</summary>
    private static FractalDescription? CutParts(FractalDescription description, long maxInstances)
    {
        var (fitting, tooDeep) = (-1, 1);
        while (tooDeep <= FractalLimits.Depth.Value && Fits(description.WithMaxDepth(tooDeep), maxInstances))
        {
            (fitting, tooDeep) = (tooDeep, 2 * tooDeep);
        }

        tooDeep = (int)Math.Min(tooDeep, FractalLimits.Depth.Value + 1);
        while (tooDeep - fitting > 1)
        {
            var depth = fitting + ((tooDeep - fitting) / 2);
            (fitting, tooDeep) = Fits(description.WithMaxDepth(depth), maxInstances) ? (depth, tooDeep) : (fitting, depth);
        }

        return fitting >= 0 ? description.WithMaxDepth(fitting) : null;
    }

    private static bool Fits(FractalDescription description, long maxInstances) =>
        !description.IsInfinite && (description.Parts.IsEmpty
            ? FractalSteps.HasAtMostInstances(description.Steps, maxInstances)
            : description.Counts.HasAtMostInstances(maxInstances));

    /// <summary>Finds the largest number of rounds with which the whole still fits; 0 where none does.</summary>
    private static int MaxRepetitionCount(ImmutableArray<FractalStep> steps, int index, Repetition repetition, long maxInstances)
    {
        var others = FractalSteps.CountUpTo(steps.RemoveAt(index), maxInstances);
        var perRound = FractalSteps.CountUpTo(repetition.Round, maxInstances);
        if (perRound <= 1)
        {
            return repetition.Count ?? (int)FractalLimits.Depth.Value;
        }

        var count = 0;
        for (var total = others * perRound; total <= maxInstances && !(count >= repetition.Count); total *= perRound)
        {
            count++;
        }

        return count;
    }
}
