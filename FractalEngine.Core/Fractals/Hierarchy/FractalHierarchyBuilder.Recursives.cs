using FractalEngine.Core.Collision;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Fractals.Hierarchy;

/// <content>The levels of recursives that call each other, and what all levels have in common.</content>
internal sealed partial class FractalHierarchyBuilder
{
    /// <summary>Adds the levels of the recursives in turns, up to that of the one that the steps are applied to.</summary>
    private void AddRecursives()
    {
        var period = _recursives.Period;
        // From here on, calls lead down by as many levels in each round.
        var nextAttempt = _recursives.MaxRoundsDown + 1L;
        for (var round = 0L; round < (_description.Levels ?? EndlessRounds); round++)
        {
            // The last round ends with the turn of the root.
            var levelCount = ((_description.Levels - 1 - round ?? EndlessRounds) * period) + _description.Root + 1;
            if (round >= nextAttempt && levelCount >= period)
            {
                var bound = CreatePeriodicBound(period, round, _recursives.MaxExpandedRounds);
                if (TryRepeatRound(bound, _recursives.EdgesAt, levelCount))
                {
                    return;
                }

                nextAttempt = round + 1 + (round / 8);
            }

            for (var turn = 0; turn < Math.Min(levelCount, period); turn++)
            {
                var level = Built.Top + 1;
                var set = _recursives.SetAt(level);
                RequireAllowedLevel(set.Maps.Length);
                _baseIndex = _recursives.BaseIndexAt(level);
                AddLevel(_childBuilder.Share(_recursives.EdgesAt(level)), set);
            }
        }
    }

    private static bool HasOnlySimilarMaps(FractalStep step) => step switch
    {
        Repetition repetition => repetition.Body.All(HasOnlySimilarMaps),
        TransformationSet set => HasOnlySimilarMaps(set.Maps.AsSpan()),
        _ => throw new ArgumentException($"{step.GetType().Name} is no step of a fractal", nameof(step)),
    };

    private static bool HasOnlySimilarMaps(ReadOnlySpan<AffineMap> maps)
    {
        foreach (ref readonly var map in maps)
        {
            if (!Similarity.IsSimilarity(map.Linear))
            {
                return false;
            }
        }

        return true;
    }

    /// <summary>
    /// Makes the boxes of edges. Those of wide levels are computed at their use: they take much memory, and only drawing needs them.
    /// </summary>
    private static Func<BoundingBox[]> EdgeBoxesOf(ChildEdge[] edges, long level, Func<long, BoundingVolume> volumeAt)
    {
        if (edges.Length > ChildGroups.MaxUngroupedChildren)
        {
            return () => ComputeEdgeBoxes(edges, level, volumeAt);
        }

        var boxes = ComputeEdgeBoxes(edges, level, volumeAt);
        return () => boxes;
    }

    private static BoundingBox[] ComputeEdgeBoxes(ChildEdge[] edges, long level, Func<long, BoundingVolume> volumeAt)
    {
        var boxes = new BoundingBox[edges.Length];
        for (var i = 0; i < boxes.Length; i++)
        {
            var volume = volumeAt(edges[i].RemainingLevels(level));
            boxes[i] = volume.Box.IsEmpty ? BoundingBox.Empty : volume.TransformedBox(edges[i].Map, edges[i].OperatorNormBound);
        }

        return boxes;
    }
}
