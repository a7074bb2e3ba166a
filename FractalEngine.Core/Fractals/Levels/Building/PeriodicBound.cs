using FractalEngine.Core.Geometry;
using FractalEngine.Core.Geometry.Hulls;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Fractals.Levels.Building;

/// <summary>
/// Proves that the bounds of the last round of a repetition, inflated a little, contain all rounds above it, however many.
/// </summary>
/// <remarks>
/// The proof is by induction: if the children of a round above lie in the inflated bounds, provided that their own children do, then so
/// does every round.
/// </remarks>
/// <param name="topLevel">Remaining levels at the top of the last round.</param>
/// <param name="period">Number of levels in a round.</param>
/// <param name="volumeAt">Gives the bounds of each level up to the top.</param>
/// <param name="edgesAt">Gives the edges of each level up to the top.</param>
/// <param name="toleranceFactor">
/// Multiple of the usual tolerance for changes, at least 1. The choice of a hull's vertices may change a little from round to round without
/// end.
/// </param>
/// <param name="arePhasesAlike">False for those of recursives, whose margins tell nothing of each other's.</param>
/// <param name="maxRoundsDown">The largest number of rounds between a sub-fractal and its children, rounded up.</param>
internal sealed class PeriodicBound(
    long topLevel, int period, Func<long, BoundingVolume> volumeAt, Func<long, ChildEdge[]> edgesAt, double toleranceFactor,
    int maxRoundsDown, bool arePhasesAlike = true)
{
    // Bounds have converged when a round changes them by less than this part of their size, or of the margin by which they are too large
    // anyway.
    private const double ConvergenceTolerance = 1e-7;
    private const double MarginTolerance = 0.05;

    // Boxes are inflated by so many times as much as they changed, at least by what rounding may change.
    private const double InflationFactor = 10;

    // Where margins had to grow, boxes may need more inflation.
    private const double InflationGrowth = 8;
    private const double MaxInflation = 0.2;

    private const double ClusterInflation = 1e-3;

    // Boxes of recursives grow until they hold those of others: a recursive may be tight in a hull, and its box be that of another box.
    private const double BoxInflation = 1e-3;
    private const int MaxBoxIterations = 32;

    private const int MaxMarginIterations = 300;

    /// <summary>Number of levels in a round.</summary>
    public int Period => period;

    /// <summary>Remaining levels at the bottom of the last round.</summary>
    public long FirstLevel { get; } = topLevel - period + 1;

    /// <summary>The lowest level of a round so far up that all its children lie in rounds like the last one.</summary>
    public long InductionLevel { get; } = topLevel + 1 + ((long)maxRoundsDown * period);

    /// <summary>Tells whether the bounds of the last two rounds differ little enough.</summary>
    public bool HasConverged() => Enumerable.Range(0, period).All(
        phase => AreNear(FirstLevel + phase, FirstLevel + phase - period, ConvergenceThreshold(phase)));

    /// <summary>The place of a level in its round, from 0 at the bottom.</summary>
    public int PhaseOf(long level) => (int)((((level - FirstLevel) % period) + period) % period);

    /// <summary>The level itself or, for one above the last round, the level of the last round with the same phase.</summary>
    public long EquivalentLevel(long level) => level <= topLevel ? level : FirstLevel + PhaseOf(level);

    /// <summary>The bounds of any level, where all rounds from the last one up share theirs.</summary>
    /// <param name="volumes">The bounds of a round by phases.</param>
    /// <param name="level">Remaining levels.</param>
    public BoundingVolume VolumeAt(BoundingVolume[] volumes, long level) => level < FirstLevel ? volumeAt(level) : volumes[PhaseOf(level)];

    /// <summary>Finds bounds that contain the last round and all rounds above it, by phases; null where none are found.</summary>
    /// <param name="children">The children of a round above, by phases.</param>
    public BoundingVolume[]? TryProveInvariant(ChildInstance[][] children)
    {
        var coveredLevels = FindCoveredLevels(children);
        if (!Enumerable.Range(0, period).All(phase => ConvergenceThreshold(phase) is var threshold
            && coveredLevels[phase].All(level => AreNear(level, FirstLevel + phase, threshold))))
        {
            return null;
        }

        var volumesWithMargins = WithInvariantMargins(
            [.. Enumerable.Range(0, period).Select(phase => volumeAt(FirstLevel + phase))], coveredLevels);
        for (var inflation = Math.Max(InflationFactor * MaxRelativeChange(), RoundingErrors.Chain); inflation < MaxInflation;
            inflation *= InflationGrowth)
        {
            BoundingVolume[] volumes = [.. volumesWithMargins.Select((volume, phase) =>
                volume with { Box = Inflate(coveredLevels[phase].Select(level => volumeAt(level).Box), inflation) })];
            for (var iteration = 0; iteration <= (arePhasesAlike ? 0 : MaxBoxIterations); iteration++)
            {
                BoundingBox[] boxes = [.. Enumerable.Range(0, period).Select(phase => BoxWithChildren(volumes, phase))];
                if (boxes.Zip(volumes).All(static item => item.First == item.Second.Box))
                {
                    return WithInvariantClusters(volumes, coveredLevels);
                }

                volumes = [.. volumes.Zip(boxes, static (volume, box) =>
                    box == volume.Box ? volume : volume with { Box = Inflate([box], BoxInflation) })];
            }
        }

        return null;
    }

    private static BoundingBox Inflate(IEnumerable<BoundingBox> boxes, double fraction)
    {
        var box = boxes.Aggregate(BoundingBox.Union);
        return box.IsEmpty ? box : BoundingVolume.Inflate(box, (fraction * box.Diagonal) + (RoundingErrors.Chain * Magnitude(box)));
    }

    private bool AreNear(long level1, long level2, double threshold) =>
        RelativeChange(volumeAt(level1), volumeAt(level2), threshold) <= threshold;

    /// <summary>
    /// Computes the change of bounds as a part of their size. Hulls that stand for many points change by up to their margins anyway.
    /// </summary>
    /// <param name="volume1">One bound.</param>
    /// <param name="volume2">The other bound.</param>
    /// <param name="cutoff">The method may return early any change above this, since boxes take far less time than hulls.</param>
    private static double RelativeChange(BoundingVolume volume1, BoundingVolume volume2, double cutoff)
    {
        if (volume1.Clusters.Length != volume2.Clusters.Length || volume1.Box.IsEmpty != volume2.Box.IsEmpty)
        {
            return 1;
        }

        var boxChange = RelativeChange(volume1.Box, volume2.Box);
        for (var i = 0; i < volume1.Clusters.Length; i++)
        {
            boxChange = Math.Max(boxChange, RelativeChange(volume1.Clusters[i], volume2.Clusters[i]));
        }

        if (boxChange > cutoff || volume1.Hull is not { } hull1 || volume2.Hull is not { } hull2)
        {
            return boxChange;
        }

        var margin = volume1.Margin + volume2.Margin;
        var change = Math.Max(MaxDistanceOutside(volume1, hull2.Vertices, margin), MaxDistanceOutside(volume2, hull1.Vertices, margin))
            - volume1.Margin - volume2.Margin - (RoundingErrors.Chain * Magnitude(volume1.Box));
        return change <= 0 ? boxChange : Math.Max(boxChange, change / volume1.Box.Diagonal);
    }

    /// <summary>
    /// Computes the change of a box as a part of its size. A change by no more than rounding counts as none, for boxes that shrink to a
    /// point do no more.
    /// </summary>
    private static double RelativeChange(BoundingBox box1, BoundingBox box2)
    {
        var change = Math.Max((box1.Minimum - box2.Minimum).MaxAbsComponent(), (box1.Maximum - box2.Maximum).MaxAbsComponent());
        return box1 == box2 || change <= RoundingErrors.Chain * Magnitude(box1) ? 0 : change / box1.Diagonal;
    }

    private static double Magnitude(BoundingBox box) => box.IsEmpty ? 0 : box.MaxAbsCoordinate();

    private static BoundingVolume[] WithoutHulls(BoundingVolume[] volumes) =>
        [.. volumes.Select(volume => volume with { Hull = null, Margin = 0 })];

    /// <summary>Computes the largest distance of some points from a hull; any value up to a floor if that is no larger.</summary>
    private static double MaxDistanceOutside(BoundingVolume outerVolume, Vector[] points, double floor)
    {
        var maxDistance = double.NegativeInfinity;
        foreach (var point in points)
        {
            var cutoff = Math.Max(floor, maxDistance);
            maxDistance = Math.Max(maxDistance, outerVolume.Hull?.DistanceUpperBound(point, cutoff) ?? double.PositiveInfinity);
        }

        return maxDistance;
    }

    private double ConvergenceThreshold(int phaseToTest)
    {
        var minRelativeMargin = double.PositiveInfinity;
        for (var phase = arePhasesAlike ? 0 : phaseToTest; phase < (arePhasesAlike ? period : phaseToTest + 1); phase++)
        {
            var volume = volumeAt(FirstLevel + phase);
            // NaN, of a volume without size, is smaller than all.
            minRelativeMargin = volume.Box.IsEmpty ? minRelativeMargin : Math.Min(minRelativeMargin, volume.Margin / volume.Box.Diagonal);
        }

        return Math.Max(ConvergenceTolerance, Math.Min(1, toleranceFactor * MarginTolerance) * minRelativeMargin);
    }

    private double MaxRelativeChange() => Enumerable.Range(0, period).Aggregate(0.0, (change, phase) => Math.Max(
        change, RelativeChange(volumeAt(FirstLevel + phase), volumeAt(FirstLevel + phase - period), double.PositiveInfinity)));

    /// <summary>
    /// Lists the levels that the bounds of each phase must contain: that of the last round, and lower ones that have parents in the first
    /// rounds above.
    /// </summary>
    private HashSet<long>[] FindCoveredLevels(ChildInstance[][] children)
    {
        var coveredLevels = Enumerable.Range(0, period).Select(phase => new HashSet<long> { FirstLevel + phase }).ToArray();
        for (var level = topLevel + 1; level < InductionLevel; level++)
        {
            foreach (var child in children[PhaseOf(level)].Where(child => !child.LevelStep.IsAbsolute))
            {
                var childLevel = child.RemainingLevels(level);
                if (childLevel < FirstLevel)
                {
                    coveredLevels[PhaseOf(childLevel)].Add(childLevel);
                }
            }
        }

        return coveredLevels;
    }

    /// <summary>Lists what the bounds of a phase must contain, but itself, where a recursive calls itself by the identity.</summary>
    private CollapsedEdge[] CollapsedEdgesOf(int phase) => [.. edgesAt(FirstLevel + phase)
        .Select(edge => CollapsedEdge.Collapse(
            edge, InductionLevel + phase, level => edgesAt(EquivalentLevel(level)), arePhasesAlike ? 0 : FirstLevel))
        .Where(edge => arePhasesAlike || edge.Map != AffineMap.Identity || edge.RemainingLevels < FirstLevel
            || PhaseOf(edge.RemainingLevels) != phase)];

    private BoundingBox BoxWithChildren(BoundingVolume[] volumes, int phase) => CollapsedEdgesOf(phase)
        .Select(edge => (Volume: VolumeAt(volumes, edge.RemainingLevels), Edge: edge)).Where(item => !item.Volume.Box.IsEmpty)
        .Select(item => item.Volume.TransformedBox(item.Edge.Map, item.Edge.OperatorNormBound))
        .Aggregate(volumes[phase].Box, BoundingBox.Union);

    /// <summary>Inflates clusters so that they contain those of the rounds above as well; removes them where that fails.</summary>
    private BoundingVolume[] WithInvariantClusters(BoundingVolume[] volumes, HashSet<long>[] coveredLevels)
    {
        BoundingVolume[] inflated = [.. volumes.Select(volume => volume with
        {
            Clusters = [.. volume.Clusters.Select(cluster => Inflate([cluster], ClusterInflation))],
        })];
        for (var phase = 0; phase < period; phase++)
        {
            var outer = inflated[phase].Clusters;
            var inner = CollapsedEdgesOf(phase).SelectMany(edge => VolumeAt(inflated, edge.RemainingLevels).TransformedClusters(edge.Map))
                .Concat(coveredLevels[phase].SelectMany(level => volumeAt(level).TransformedClusters(AffineMap.Identity)));
            if (!inner.All(box => box.IsEmpty || outer.Any(cluster => BoundingBox.Union(cluster, box) == cluster)))
            {
                return [.. volumes.Select(volume => volume with { Clusters = [] })];
            }
        }

        return inflated;
    }

    /// <summary>Gives the hulls margins by which they contain the rounds above as well; removes the hulls where there are none.</summary>
    private BoundingVolume[] WithInvariantMargins(BoundingVolume[] volumes, HashSet<long>[] coveredLevels)
    {
        var edges = Enumerable.Range(0, period)
            .SelectMany(phase => CollapsedEdgesOf(phase).Select(edge => (Phase: phase, Edge: edge))).ToArray();
        var fixedVolumes = edges.Where(item => item.Edge.RemainingLevels < FirstLevel).Select(item => item.Edge.RemainingLevels)
            .Concat(coveredLevels.SelectMany(levels => levels)).Select(volumeAt);
        if (volumes.Concat(fixedVolumes).Any(volume => volume.Hull is null && !volume.Box.IsEmpty))
        {
            return WithoutHulls(volumes);
        }

        var margins = coveredLevels.Select((levels, phase) => levels.Select(volumeAt).Where(volume => volume.Hull is not null)
            .Select(volume => volume.Margin + MaxDistanceOutside(volumes[phase], volume.Hull!.Vertices, 0))
            .DefaultIfEmpty().Max()).ToArray();
        var vertexDistances = edges.Select(item => VolumeAt(volumes, item.Edge.RemainingLevels).Hull is { } hull
            ? MaxDistanceOutside(volumes[item.Phase], [.. hull.Vertices.Select(vertex => item.Edge.Map * vertex)], 0)
            : double.NegativeInfinity).ToArray();
        for (var iteration = 0; iteration < MaxMarginIterations; iteration++)
        {
            var isInvariant = true;
            for (var i = 0; i < edges.Length; i++)
            {
                // A margin holds if it is no less than the distance of a child's vertices plus the child's own margin.
                var (phase, edge) = edges[i];
                var childMargin = edge.RemainingLevels < FirstLevel
                    ? volumeAt(edge.RemainingLevels).Margin
                    : margins[PhaseOf(edge.RemainingLevels)];
                var requiredMargin = vertexDistances[i] + (edge.OperatorNormBound * childMargin);
                isInvariant &= requiredMargin <= margins[phase];
                // A little more than needed makes the iteration end.
                margins[phase] = Math.Max(margins[phase], requiredMargin * (1 + ConvergenceTolerance));
            }

            if (isInvariant)
            {
                return [.. volumes.Select((volume, phase) => volume with { Margin = margins[phase] })];
            }
        }

        return WithoutHulls(volumes);
    }
}
