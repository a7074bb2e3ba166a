using FractalEngine.Core.Geometry;

namespace FractalEngine.Core.Collision.Fractals;

/// <summary>
/// Shows that the last round of a repetition, widened a little, holds all rounds above it, however many. If all that a round above is made
/// of is held by the widened one, provided that what is below is, then, by induction, so it is at every depth.
/// </summary>
/// <param name="topLevel">Its uppermost level.</param>
/// <param name="period">Its number of levels.</param>
/// <param name="volumeAt">Of all levels up to the top.</param>
/// <param name="edgesAt">Of all levels up to the top.</param>
/// <param name="toleranceFactor">
/// From 1 upwards: what may change, as a multiple of the usual. Which corners a hull keeps may change a little from round to round without
/// end.
/// </param>
internal sealed class PeriodicBound(long topLevel, int period, Func<long, BoundingVolume> volumeAt, Func<long, ChildEdge[]> edgesAt,
    double toleranceFactor)
{
    // Bounds settle when a round changes them by less than this part of their size, or of the margin by which they are too large anyway.
    // They are then widened by ten times as much as they changed, or by what rounding may change.
    private const double ConvergenceTolerance = 1e-7;
    private const double MarginTolerance = 0.05;
    private const double InflationFactor = 10;
    private const double Rounding = 1e-14;

    // Where margins had to grow, boxes may need more.
    private const double InflationGrowth = 8;
    private const double MaxInflation = 0.2;

    private const int MaxMarginIterations = 300;

    /// <summary>Its lowest level.</summary>
    public long FirstLevel { get; } = topLevel - period + 1;

    /// <summary>The lowest level of a round so far up that all its copies are of levels in rounds like this one.</summary>
    public long InductionLevel { get; } = topLevel + 1 + (ChildInstanceBuilder.MaxExpandedLevels * (long)period);

    /// <summary>False where the bounds of the last two rounds differ too much.</summary>
    public bool HasConverged() => MaxRelativeChange() <= ConvergenceThreshold();

    /// <summary>The place of a level in its round, 0 the lowest.</summary>
    public int PhaseOf(long level) => (int)((((level - FirstLevel) % period) + period) % period);

    /// <summary>The level itself or, for one above the round, that in the round which is like it.</summary>
    public long EquivalentLevel(long level) => level <= topLevel ? level : FirstLevel + PhaseOf(level);

    /// <summary>The outline of any level: those of the rounds above are the same.</summary>
    public BoundingVolume VolumeAt(BoundingVolume[] volumes, long level) => level < FirstLevel ? volumeAt(level) : volumes[PhaseOf(level)];

    /// <summary>Outlines that hold this round and all rounds above it; null where none are found.</summary>
    /// <param name="children">Of a round above, by their places.</param>
    public BoundingVolume[]? TryProveInvariant(ChildInstance[][] children)
    {
        // Copies in the first rounds above are of levels below this one; what is said of it must hold for those as well.
        var coveredLevels = Enumerable.Range(0, period).Select(i => new HashSet<long> { FirstLevel + i }).ToArray();
        for (var level = topLevel + 1; level < InductionLevel; level++)
        {
            foreach (var childLevel in children[PhaseOf(level)].Where(child => !child.LevelStep.IsAbsolute)
                .Select(child => child.RemainingLevels(level)).Where(childLevel => childLevel < FirstLevel))
            {
                coveredLevels[PhaseOf(childLevel)].Add(childLevel);
            }
        }

        if (!coveredLevels.Select((levels, i) => levels.Max(level => RelativeChange(volumeAt(level).Box, volumeAt(FirstLevel + i).Box)))
            .All(change => change <= ConvergenceThreshold()))
        {
            return null;
        }

        var volumesWithMargins = WithInvariantMargins([.. Enumerable.Range(0, period).Select(i => volumeAt(FirstLevel + i))],
            coveredLevels);
        for (var inflation = Math.Max(InflationFactor * MaxRelativeChange(), Rounding); inflation < MaxInflation;
            inflation *= InflationGrowth)
        {
            BoundingVolume[] volumes =
                [.. volumesWithMargins.Select(
                    (volume, i) => volume with { Box = Inflate(coveredLevels[i].Select(level => volumeAt(level).Box), inflation) })];
            if (Enumerable.Range(0, period).All(i => ContainsChildren(volumes, i)))
            {
                return volumes;
            }
        }

        return null;
    }

    private static BoundingBox Inflate(IEnumerable<BoundingBox> boxes, double fraction) =>
        boxes.Aggregate(BoundingBox.Union) switch { var box =>
            BoundingVolume.Inflate(box, (fraction * box.Diagonal) + (Rounding * Magnitude(box))) };

    /// <summary>By which part of its size a box changes, rounding left out: what shrinks to a point does no more.</summary>
    private static double RelativeChange(BoundingBox box1, BoundingBox box2)
    {
        var change = Math.Max((box1.Minimum - box2.Minimum).MaxAbsComponent(), (box1.Maximum - box2.Maximum).MaxAbsComponent());
        return box1 == box2 || change <= Rounding * Magnitude(box1) ? 0 : change / box1.Diagonal;
    }

    private static double Magnitude(BoundingBox box) =>
        box.IsEmpty ? 0 : Math.Max(box.Minimum.MaxAbsComponent(), box.Maximum.MaxAbsComponent());

    private static BoundingVolume[] WithoutHulls(BoundingVolume[] volumes) =>
        [.. volumes.Select(volume => volume with { Hull = null, Margin = 0 })];

    private double ConvergenceThreshold() => Math.Max(
        ConvergenceTolerance, Math.Min(1, toleranceFactor * MarginTolerance) * Enumerable.Range(0, period)
        .Select(i => volumeAt(FirstLevel + i)).Min(volume => volume.Margin / volume.Box.Diagonal));

    private double MaxRelativeChange() =>
        Enumerable.Range(0, period).Max(i => RelativeChange(volumeAt(FirstLevel + i).Box, volumeAt(FirstLevel + i - period).Box));

    private bool ContainsChildren(BoundingVolume[] volumes, int phase)
    {
        var outerBox = volumes[phase].Box;
        return edgesAt(FirstLevel + phase)
            .Select(edge => CollapsedEdge.Collapse(edge, InductionLevel + phase, level => edgesAt(EquivalentLevel(level))))
            .Select(collapsedEdge => VolumeAt(volumes, collapsedEdge.RemainingLevels)
            .TransformedBox(collapsedEdge.Map, collapsedEdge.OperatorNormBound)).All(box => BoundingBox.Union(outerBox, box) == outerBox);
    }

    /// <summary>Gives the hulls margins by which they hold the rounds above as well; takes the hulls away where there are none.</summary>
    private BoundingVolume[] WithInvariantMargins(BoundingVolume[] volumes, HashSet<long>[] coveredLevels)
    {
        var collapsedEdges = Enumerable.Range(0, period)
            .SelectMany(i => edgesAt(FirstLevel + i)
            .Select(edge => (Place: i, Part: CollapsedEdge.Collapse(edge, InductionLevel + i, level => edgesAt(EquivalentLevel(level))))))
            .ToArray();
        var childVolumes = collapsedEdges.Where(item => item.Part.RemainingLevels < FirstLevel).Select(item => item.Part.RemainingLevels)
            .Concat(coveredLevels.SelectMany(levels => levels)).Select(volumeAt);
        if (volumes.Any(volume => volume.Hull is null) || childVolumes.Any(volume => volume.Hull is null && !volume.Box.IsEmpty))
        {
            return WithoutHulls(volumes);
        }

        // A margin holds if it is no less than what corners miss by, and a part's margin on top of that.
        var margins = coveredLevels.Select((levels, i) => levels.Select(volumeAt).Where(volume => volume.Hull is not null)
            .Max(volume => volume.Margin + MaxDistanceOutside(volumes[i], volume.Hull!.Vertices))).ToArray();
        var vertexDistances = collapsedEdges.Select(item => VolumeAt(volumes, item.Part.RemainingLevels).Hull is { } hull
            ? MaxDistanceOutside(volumes[item.Place], hull.Vertices.Select(vertex => item.Part.Map * vertex))
            : double.NegativeInfinity).ToArray();
        for (var iteration = 0; iteration < MaxMarginIterations; iteration++)
        {
            var isInvariant = true;
            for (var i = 0; i < collapsedEdges.Length; i++)
            {
                var (phase, collapsedEdge) = collapsedEdges[i];
                var requiredMargin = vertexDistances[i]
                    + (collapsedEdge.OperatorNormBound
                        * (collapsedEdge.RemainingLevels < FirstLevel
                        ? volumeAt(collapsedEdge.RemainingLevels).Margin
                        : margins[PhaseOf(collapsedEdge.RemainingLevels)]));
                isInvariant &= requiredMargin <= margins[phase];
                // A little more than needed, so that it ends.
                margins[phase] = Math.Max(margins[phase], requiredMargin * (1 + ConvergenceTolerance));
            }

            if (isInvariant)
            {
                return [.. volumes.Select((volume, i) => volume with { Margin = margins[i] })];
            }
        }

        return WithoutHulls(volumes);
    }

    private static double MaxDistanceOutside(BoundingVolume outerVolume, IEnumerable<Maths.Vector> points) =>
        points.Max(outerVolume.Hull!.DistanceUpperBound);
}
