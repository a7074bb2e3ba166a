using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Fractals.Levels.Building;

/// <summary>A chain of edges collapsed into one: the sub-fractal that they lead to is one part of the parent.</summary>
/// <param name="Map">The map from the frame of the part to that of the parent.</param>
/// <param name="OperatorNormBound">Upper bound of the factor by which the map lengthens vectors.</param>
/// <param name="RemainingLevels">Remaining levels of the part.</param>
internal readonly record struct CollapsedEdge(AffineMap Map, double OperatorNormBound, long RemainingLevels)
{
    private const int MaxCollapsedEdges = 64;

    /// <summary>Follows an edge, and goes on through levels that have a single edge.</summary>
    /// <param name="edge">The first edge.</param>
    /// <param name="parentLevels">Remaining levels of the parent.</param>
    /// <param name="edgesAt">Gives the edges of a level by its remaining levels.</param>
    /// <param name="floor">No further edge of a level from here up is followed to below it, but one to a fixed level.</param>
    /// <remarks>A shear and a rotation may each lengthen what they shorten together, so that their product has the better bounds.</remarks>
    public static CollapsedEdge Collapse(ChildEdge edge, long parentLevels, Func<long, ChildEdge[]> edgesAt, long floor = 0)
    {
        var map = edge.Map;
        var remainingLevels = edge.RemainingLevels(parentLevels);
        for (var collapsedCount = 0; collapsedCount < MaxCollapsedEdges && remainingLevels > 0; collapsedCount++)
        {
            if (edgesAt(remainingLevels) is not [var only]
                || (!only.LevelStep.IsAbsolute && remainingLevels >= floor && only.RemainingLevels(remainingLevels) < floor))
            {
                break;
            }

            map *= only.Map;
            remainingLevels = only.RemainingLevels(remainingLevels);
        }

        return new(map, BoundingSphere.OperatorNormBound(map.Linear) * (1 + RoundingErrors.Chain), remainingLevels);
    }
}
