using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Collision;

/// <summary>One of the parts that a sub-fractal is the union of: the image of another one.</summary>
/// <param name="Map">From the frame of the part to that of the whole.</param>
/// <param name="Lengthening">The most by which the map lengthens.</param>
/// <param name="Level">The levels left in the part.</param>
internal readonly record struct Part(AffineMap Map, double Lengthening, long Level)
{
    private const double Rounding = 1e-14;
    private const int MostSteps = 64;

    /// <summary>Where a step leads.</summary>
    /// <param name="step">From a level.</param>
    /// <param name="level">The level.</param>
    /// <param name="stepsAt">
    /// Of the levels below. Those that are a single step are gone through: a shear and a turn may each lengthen what together they shorten.
    /// </param>
    public static Part Of(CopyStep step, long level, Func<long, CopyStep[]> stepsAt)
    {
        var (map, below) = (step.Map, step.LevelsLeft(level));
        for (var taken = 0; taken < MostSteps && below > 0 && stepsAt(below) is [var only]; taken++)
        {
            (map, below) = (map * only.Map, only.LevelsLeft(below));
        }

        return new(map, BoundingSphere.LengtheningBound(map.Linear) * (1 + Rounding), below);
    }
}
