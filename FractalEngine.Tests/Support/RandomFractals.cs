using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Maths;

namespace FractalEngine.Tests.Support;

/// <summary>
/// Creates small fractals of every shape: with rotations, skew, mirrors, the identity, and sets before, behind and between recursives.
/// </summary>
internal static class RandomFractals
{
    private const int MaxInstances = 200;

    // Oracles that compare maps by one relative tolerance can't tell what these set apart; others draw from all of RandomShapes.
    private const MapTraits BeyondOracles = MapTraits.Outliers | MapTraits.NearlyFlat | MapTraits.LargeScales;

    /// <summary>Creates one by <see cref="Create"/>, or one of <see cref="RandomShapes"/> with all that oracles can tell.</summary>
    public static Fractal CreateAny(Random random, Composition composition = Composition.Affine) =>
        composition == Composition.Affine && random.Next(2) == 0
            ? RandomShapes.Create(random, MaxInstances, 4 * MaxInstances, BeyondOracles)
            : Create(random, composition);

    public static Fractal Create(Random random, Composition composition = Composition.Affine, bool infinite = false)
    {
        TransformationSet[] body = random.Next(3) == 0 ? [RandomSet(random), RandomSet(random, 2)] : [RandomSet(random)];
        List<FractalStep> steps = [new Repetition([.. body], infinite ? null : random.Next(0, body.Length == 1 ? 4 : 3))];
        if (random.Next(2) == 0)
        {
            steps.Add(RandomSet(random, 2));
        }

        if (random.Next(2) == 0)
        {
            steps.Insert(0, RandomSet(random, 2));
        }

        if (random.Next(4) == 0)
        {
            steps.Add(new Repetition([new Repetition([RandomSet(random, 2)], 1)], 2));
        }

        return new(new([.. steps], composition), Samples.Tetrahedron);
    }

    private static TransformationSet RandomSet(Random random, int maxCount = 4) =>
        new([.. Enumerable.Range(0, random.Next(1, maxCount + 1)).Select(_ => RandomMap(random))]);

    private static Transformation RandomMap(Random random) =>
        random.Next(6) == 0 ? Transformation.Identity : random.Transformation();
}
