using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Maths;

namespace FractalEngine.Tests.Support;

/// <summary>
/// Draws fractals of all the sorts that break bounds and searches, small enough to expand: any mesh of <see cref="RandomMeshes"/> under
/// sets of <see cref="RandomMapSets"/>, before, behind and inside repetitions. The same numbers give the same fractal.
/// </summary>
internal static class RandomShapes
{
    private const int MaxLevels = 12;

    /// <summary>Draws a fractal of at least one instance.</summary>
    /// <param name="random">The numbers.</param>
    /// <param name="maxInstances">Most instances, equal ones counted.</param>
    /// <param name="maxFaces">Most faces of all instances, where one has no more.</param>
    /// <param name="excluded">What the maps must not have.</param>
    public static Fractal Create(Random random, int maxInstances = 400, int maxFaces = 4000, MapTraits excluded = MapTraits.None)
    {
        var mesh = RandomMeshes.Create(random);
        var budget = Math.Max(1, Math.Min(maxInstances, maxFaces / mesh.FaceCount));
        IEnumerable<FractalStep> steps = CreateSteps(random, budget, excluded);
        var centre = mesh.Bounds.Centre;
        var isMovable = centre.MaxAbsComponent() > 1e-9
            && (centre.MaxAbsComponent() < 1e5 || (excluded & MapTraits.Outliers) == 0);
        var place = !isMovable ? 0 : random.Draw((55, 0), (30, 1), (15, 2));
        steps = place == 1 ? steps.Select(step => About(centre, step)) : place == 2 ? steps.Append(Return(random, centre)) : steps;
        return new(new([.. steps]), mesh);
    }

    /// <summary>Makes the same step about another centre than the origin, so that the fractal stays around it.</summary>
    private static FractalStep About(Vector centre, FractalStep step) => step is Repetition repetition
        ? new Repetition([.. repetition.Round.Select(inner => About(centre, inner))], repetition.Count)
        : TransformationSet.Of(((TransformationSet)step).Transformations.Select(map => map == Transformation.Identity
            ? map
            : map with { Position = map.Position + centre - (map.ToAffineMap().Linear * centre) }));

    /// <summary>Makes a step that moves a base mesh to the origin: rounding of its coordinates is large beside the result.</summary>
    private static TransformationSet Return(Random random, Vector centre)
    {
        var angles = 90 * new Vector(random.Next(-1, 2), random.Next(4), random.Next(4));
        var rotation = random.Draw((1, Vector.Zero), (1, angles), (1, random.Degrees()));
        var map = new Transformation(Vector.Zero, rotation, Vector.One);
        return TransformationSet.Of(map with { Position = -(map.ToAffineMap().Linear * centre) });
    }

    private static List<FractalStep> CreateSteps(Random random, int budget, MapTraits excluded)
    {
        List<FractalStep> steps = [];
        var levels = 0;
        do
        {
            var width = Math.Min(budget, random.Happens(8) ? random.Next(65, 100) : random.Next(1, 9));
            List<FractalStep> round = [RandomMapSets.Create(random, width, excluded)];
            var perRound = width;
            if (random.Happens(12) && (excluded & (MapTraits.UnevenScales | MapTraits.LargeScales)) == 0)
            {
                // Each turns what the other stretches, so that chains are sheared.
                var (stretch, turn) = (random.Between(1, 2), random.Between(10, 80));
                round.Add(TransformationSet.Of(new Transformation(Vector.Zero, new(0, 0, turn), new(stretch, 1 / stretch, 1))));
                round.Add(TransformationSet.Of(new Transformation(Vector.Zero, new(0, -turn, 0), new(1 / stretch, stretch, 1))));
            }

            if (random.Happens(15) && 2 * perRound <= budget)
            {
                round.Add(random.Next(2) == 0
                    ? RandomMapSets.Create(random, 2, excluded)
                    : new Repetition([RandomMapSets.Create(random, 2, excluded)], 1));
                perRound *= 2;
            }

            var count = random.Happens(5) ? 0 : 1;
            var instances = count == 0 ? 1 : perRound;
            // Deep rather than shallow: bounds are those of several levels.
            while (count > 0 && instances * (long)perRound <= budget && levels + ((count + 1) * round.Count) <= MaxLevels
                && random.Happens(85))
            {
                count++;
                instances *= perRound;
            }

            steps.Add(count == 1 && round.Count == 1 ? round[0] : new Repetition([.. round], count));
            budget /= instances;
            levels += count * round.Count;
        }
        while (budget > 1 && levels < MaxLevels && random.Happens(50));
        return steps;
    }
}
