using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Levels;

namespace FractalEngine.Core.Visibility.Levels;

/// <summary>
/// The mean of the tints that the instances of each sub-fractal get, which its proxy has. Means obey the rule of tints themselves, so that
/// each follows from those of the levels below, weighted by the areas of the children, or by their numbers where maps are no similarities.
/// </summary>
internal static class MeanTints
{
    // Levels that recur are followed so far: after these, tints have converged, or never change a colour by much.
    private const long MaxRounds = 64;

    // Weights of wide sets multiply with each level.
    private const double MaxWeight = 1e200;

    /// <summary>Computes the mean of each level.</summary>
    /// <param name="hierarchy">The levels.</param>
    /// <returns>One for each of <see cref="FractalHierarchy.AllLevels"/>, in their order.</returns>
    public static Tint[] Compute(FractalHierarchy hierarchy)
    {
        var levels = hierarchy.AllLevels.Items;
        var regions = hierarchy.AllLevels.Regions;
        var means = new Tint[levels.Length];
        var weights = new double[levels.Length];
        Array.Fill(means, Tint.None);
        foreach (var region in regions)
        {
            var isFinite = true;
            for (var offset = 0L; offset < Math.Min(region.LevelCount, MaxRounds * region.Period) && isFinite; offset++)
            {
                var level = region.FirstLevel + offset;
                var index = LevelRegion.FindIndex(regions, level);
                (means[index], weights[index]) = hierarchy.IsBase(level)
                    ? (Tint.None, hierarchy.BaseMeshes[levels[index].BaseIndex].SurfaceArea())
                    : Sum(levels[index], level, regions);
                isFinite = weights[index] is 0 or (> 1 / MaxWeight and < MaxWeight);
            }
        }

        return means;

        (Tint Mean, double Weight) Sum(HierarchyLevel level, long remainingLevels, ReadOnlySpan<LevelRegion> all)
        {
            var (sum, weight) = (default(Tint), 0.0);
            foreach (var (i, edge) in level.Edges.Index())
            {
                var child = LevelRegion.FindIndex(all, edge.RemainingLevels(remainingLevels));
                var share = (level.Set!.Pick?.ShareOf(remainingLevels, i) ?? 1) * weights[child]
                    * (hierarchy.HasOnlySimilarities ? edge.Set.ScalesSquared[edge.MapIndex] : 1);
                sum += share * Tint.Of(edge.Set.ColourOf(edge.MapIndex)).Then(means[child]);
                weight += share;
            }

            return weight > 0 ? ((1 / weight) * sum, weight) : (Tint.None, 0);
        }
    }
}
