using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Geometry.Hulls;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Fractals.Levels.Building;

/// <content>The levels of recursives that call each other, and what all levels have in common.</content>
internal sealed partial class FractalHierarchyBuilder
{
    // More are not compared, though a cycle of calls may take as many.
    private const int MaxPeriodInRounds = 16;

    /// <summary>Adds the levels of the recursives in turns, up to that of the one that the steps are applied to.</summary>
    private void AddRecursives()
    {
        var period = _recursives.Period;
        var nextAttempt = 0L;
        for (var round = 0L; round < (_description.Levels ?? EndlessRounds); round++)
        {
            // The last round ends with the turn of the root.
            var levelCount = ((_description.Levels - 1 - round ?? EndlessRounds) * period) + _description.Root + 1;
            if (round >= nextAttempt)
            {
                // Recursives that call only each other alternate: they may have faces only as often as a cycle of calls comes round.
                var maxPeriod = Math.Min(period * Math.Max(1, _recursives.MaxRoundsDown), MaxPeriodInRounds);
                for (var rounds = 1; rounds <= maxPeriod; rounds++)
                {
                    if (TryRepeatRounds(rounds, round, levelCount))
                    {
                        return;
                    }
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

    /// <summary>Replaces all remaining levels of the recursives by rounds that are inflated a little, if that can be proved.</summary>
    /// <param name="rounds">After so many rounds the bounds recur.</param>
    /// <param name="builtRounds">Number of rounds that were built.</param>
    /// <param name="levelCount">Number of the remaining levels.</param>
    private bool TryRepeatRounds(int rounds, long builtRounds, long levelCount)
    {
        var period = rounds * _recursives.Period;
        // Two periods are compared, and in the last one calls lead down by as many levels as further up.
        return builtRounds >= Math.Max(2 * rounds, _recursives.MaxRoundsDown + rounds) && levelCount >= period
            && TryRepeatRound(
                CreatePeriodicBound(period, builtRounds, _recursives.MaxExpandedRounds, arePhasesAlike: false),
                _recursives.EdgesAt,
                levelCount);
    }

    private static bool HasOnlySimilarMaps(FractalStep step) => step switch
    {
        Repetition repetition => repetition.Round.All(HasOnlySimilarMaps),
        TransformationSet set => HasOnlySimilarMaps(set.Maps.AsSpan()),
        _ => throw new ArgumentException($"{step.GetType().Name} is no step of a fractal", nameof(step)),
    };

    private static bool HasOnlySimilarMaps(ReadOnlySpan<AffineMap> maps)
    {
        foreach (ref readonly var map in maps)
        {
            if (!map.Linear.IsChainableSimilarity())
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
        if (edges.Length > SubFractal.MaxUngroupedChildren)
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
