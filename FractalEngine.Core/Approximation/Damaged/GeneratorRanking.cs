using FractalEngine.Core.Approximation.Damaged.Placements;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Approximation.Damaged;

/// <summary>
/// Ranks maps between elements by how likely they are those that a tree was made by, rather than products and quotients of these: with a
/// small network (paper §6.2), whose weights the benchmark trains.
/// </summary>
internal static class GeneratorRanking
{
    /// <summary>How many maps are compared with each other.</summary>
    public const int MaxMaps = 48;

    private static readonly Lazy<Perceptron> Trained = new(() =>
    {
        using var stream = typeof(GeneratorRanking).Assembly.GetManifestResourceStream("generators.txt")!;
        return Perceptron.Parse(new StreamReader(stream).ReadToEnd());
    });

    /// <summary>Returns the maps, the likeliest first.</summary>
    /// <param name="relations">At most <see cref="MaxMaps"/> maps that make smaller, most supported first.</param>
    /// <param name="model">The elements.</param>
    public static List<AffineMap> Rank(List<Relation> relations, DamagedModel model)
    {
        var features = FeaturesOf(relations, model);
        return [.. relations.Select((relation, index) => (relation.Map, Score: ScoreOf(features[index])))
            .OrderByDescending(ranked => ranked.Score).Select(ranked => ranked.Map)];
    }

    /// <summary>Computes the output of the network: above 0 where a map is likelier one that a tree was made by than not.</summary>
    public static double ScoreOf(double[] features) => Trained.Value.Evaluate(features, stackalloc double[Trained.Value.Hidden.Length]);

    /// <summary>Computes the inputs of the network for each map, all about 0 to 1.</summary>
    /// <inheritdoc cref="Rank"/>
    public static double[][] FeaturesOf(List<Relation> relations, DamagedModel model)
    {
        var count = relations.Count;
        var (made, before, after) = (new int[count], new int[count], new int[count]);
        for (var outer = 0; outer < count; outer++)
        {
            for (var inner = 0; inner < count; inner++)
            {
                var product = relations[outer].Map * relations[inner].Map;
                if (relations.FindIndex(relation => model.AreNear(relation.Map, product)) is var index and >= 0)
                {
                    made[index]++;
                    after[outer]++;
                    before[inner]++;
                }
            }
        }

        return [.. relations.Select((relation, index) => new[]
        {
            relation.Support / relations[0].Support,
            Math.Log(1 + relation.Support) / Math.Log(1 + model.Elements.Count),
            (double)index / count,
            Math.Cbrt(Math.Abs(relation.Map.Linear.Determinant())),
            1 - (1.0 / (1 + made[index])),
            1 - (1.0 / (1 + before[index])),
            1 - (1.0 / (1 + after[index])),
            (double)(before[index] + after[index]) / (1 + before.Max() + after.Max()),
        })];
    }
}
