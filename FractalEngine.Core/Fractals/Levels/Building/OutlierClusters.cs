using System.Collections.Immutable;
using FractalEngine.Core.Fractals.Graphs;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Geometry.Hulls;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Fractals.Levels.Building;

/// <summary>
/// Computes the boxes of <see cref="ClusterBounds"/> while a <see cref="FractalHierarchy"/> is built, for fractals with maps that throw
/// instances far away.
/// </summary>
internal sealed class OutlierClusters
{
    // A map whose translation or scale is so many times the median of its set throws instances far away from the others.
    private const double OutlierFactor = 30;

    private readonly double _baseDiagonal;
    private readonly bool _hasOutliers;

    /// <summary>Determines whether a fractal has such maps.</summary>
    public OutlierClusters(FractalGraph graph)
    {
        _baseDiagonal = graph.BaseMeshes.Where(static mesh => mesh.FaceCount > 0)
            .Select(static mesh => mesh.UsedBounds.Diagonal).DefaultIfEmpty().Max();
        _hasOutliers = graph.Parts.Any(part => part.MapSets.Any(HasOutliers));
    }

    /// <summary>Computes the clusters of the union of some parts: the bulk, then what outliers throw away, the farthest first.</summary>
    /// <remarks>
    /// Outliers of the parts surround the parts in the same arrangement, so those of one rank form one cluster. The nearest join the bulk
    /// when there are too many.
    /// </remarks>
    /// <param name="edges">The parts, none of them empty.</param>
    /// <param name="volumeAt">Gives the bounds of a level by its remaining levels.</param>
    /// <returns>None for fractals without outliers.</returns>
    public BoundingBox[] Compute(IEnumerable<CollapsedEdge> edges, Func<long, BoundingVolume> volumeAt)
    {
        if (!_hasOutliers)
        {
            return [];
        }

        double[] reaches = [.. edges.Select(edge => MapReach(edge.Map))];
        var maxReach = OutlierFactor * MedianOf([.. reaches]);
        List<BoundingBox> clusters = [BoundingBox.Empty];
        clusters.AddRange(edges.Where((_, i) => reaches[i] > maxReach)
            .Select(edge => volumeAt(edge.RemainingLevels).Box.Transform(edge.Map)));
        var outlierCount = clusters.Count - 1;
        foreach (var edge in edges.Where((_, i) => reaches[i] <= maxReach))
        {
            foreach (var (rank, box) in volumeAt(edge.RemainingLevels).TransformedClusters(edge.Map).Index())
            {
                var target = rank == 0 ? 0 : rank + outlierCount;
                if (target == clusters.Count)
                {
                    clusters.Add(BoundingBox.Empty);
                }

                clusters[target] = BoundingBox.Union(clusters[target], box);
            }
        }

        while (clusters.Count > ClusterBounds.MaxBoxes)
        {
            clusters[0] = BoundingBox.Union(clusters[0], clusters[^1]);
            clusters.RemoveAt(clusters.Count - 1);
        }

        return [.. clusters.Where(cluster => !cluster.IsEmpty)];
    }

    private bool HasOutliers(ImmutableArray<AffineMap> maps)
    {
        if (maps.Length < 2)
        {
            return false;
        }

        double[] reaches = [.. maps.Select(MapReach)];
        var median = MedianOf(reaches);
        return reaches[^1] > OutlierFactor * median;
    }

    /// <summary>Sorts some numbers, and returns the lower one of those in the middle.</summary>
    private static double MedianOf(double[] numbers)
    {
        Array.Sort(numbers);
        return numbers[(numbers.Length - 1) / 2];
    }

    private double MapReach(AffineMap map) => map.Translation.MaxAbsComponent() + (map.Linear.MaxAbsEntry() * _baseDiagonal);
}
