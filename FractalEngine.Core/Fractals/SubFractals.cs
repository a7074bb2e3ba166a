using System.Collections.Immutable;
using FractalEngine.Core.Fractals.Descriptions;

namespace FractalEngine.Core.Fractals;

/// <summary>Makes the fractals that a fractal consists of.</summary>
public static class SubFractals
{
    /// <summary>Makes the fractal without its outermost levels: every sub-fractal at that depth is an instance of it.</summary>
    /// <param name="fractal">The whole fractal, in affine composition.</param>
    /// <param name="depth">Number of levels to leave out, at most as many as the fractal has.</param>
    public static Fractal Of(Fractal fractal, long depth) =>
        new(fractal.Description with { Steps = Drop(fractal.Description.Steps, depth) }, fractal.BaseMesh);

    private static ImmutableArray<FractalStep> Drop(ImmutableArray<FractalStep> steps, long count)
    {
        while (count > 0 && !steps.IsEmpty)
        {
            var first = steps[0];
            var rest = steps.RemoveAt(0);
            if (first.LevelCount is { } levels && levels <= count)
            {
                count -= levels;
                steps = rest;
                continue;
            }

            // Only a repetition has several levels. What is left of the round that is begun comes before the whole rounds.
            var repetition = (Repetition)first;
            var rounds = count / repetition.LevelsPerRound;
            var begun = count % repetition.LevelsPerRound;
            var left = repetition.Count is { } all ? (int?)(all - rounds - (begun > 0 ? 1 : 0)) : null;
            var round = begun > 0 ? Drop(repetition.Round, begun) : [];
            return [.. round, repetition.WithCount(left), .. rest];
        }

        return steps;
    }
}
