using FractalEngine.Benchmarks.Approximation.Unseen;
using FractalEngine.Core.Approximation.Damaged;
using FractalEngine.Core.Approximation.Damaged.Placements;
using FractalEngine.Core.Maths;

namespace FractalEngine.Benchmarks.Approximation;

/// <summary>The maps between elements of one damaged tree, and which of them it was made by.</summary>
/// <param name="Features">What a ranking may know of each map, the most supported one first, [maps][features].</param>
/// <param name="IsGenerator">Whether the tree was made by it, [maps].</param>
/// <param name="GeneratorCount">By how many maps the tree was made, also such as are not among them.</param>
internal sealed record RankingCase(double[][] Features, bool[] IsGenerator, int GeneratorCount)
{
    // Images of elements that differ by less, as a part of the diagonal, are the same.
    private const double SameImage = 2e-3;

    /// <summary>Makes the case of a fractal; null where the damage leaves nothing to learn from.</summary>
    public static RankingCase? Create(FractalKind kind, int seed, int faces, Damage damage)
    {
        var clean = UnseenFractals.Create(kind, seed, faces);
        if (!damage.IsMeaningful(clean))
        {
            return null;
        }

        var mesh = damage.Apply(clean, seed).Mesh;
        var model = DamagedModel.Create(mesh, DamagedModel.EstimateNoise(mesh, default) ?? 0, default);
        var maps = new HypothesisSearch(model, new(), default).FindMapsOfTrees();
        var places = model.Elements.Select(element => element.Placement.Translation).Take(50).ToArray();
        return maps.Count == 0 ? null : new(
            GeneratorRanking.FeaturesOf(maps, model),
            [.. maps.Select(map => clean.Generators.Any(generator => IsSame(map.Map, generator.Map)))],
            clean.Generators.Length);

        bool IsSame(AffineMap map1, AffineMap map2) =>
            places.All(place => ((map1 * place) - (map2 * place)).Length() < SameImage * model.Diagonal);
    }
}
