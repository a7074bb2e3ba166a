using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Collision.Fractals;

/// <summary>One of the parts that a sub-fractal is the union of: the image of another one.</summary>
/// <param name="Map">From the frame of the part to that of the whole.</param>
/// <param name="OperatorNormBound">The most by which the map lengthens.</param>
/// <param name="RemainingLevels">The levels left in the part.</param>
internal readonly record struct CollapsedEdge(AffineMap Map, double OperatorNormBound, long RemainingLevels)
{
    private const double Rounding = 1e-14;
    private const int MaxCollapsedEdges = 64;

    /// <summary>Where a step leads.</summary>
    /// <param name="edge">From a level.</param>
    /// <param name="parentLevels">The level.</param>
    /// <param name="edgesAt">
    /// Of the levels below. Those that are a single step are gone through: a shear and a turn may each lengthen what together they shorten.
    /// </param>
    public static CollapsedEdge Collapse(ChildEdge edge, long parentLevels, Func<long, ChildEdge[]> edgesAt)
    {
        var (map, remainingLevels) = (edge.Map, edge.RemainingLevels(parentLevels));
        for (var collapsedCount = 0; collapsedCount < MaxCollapsedEdges && remainingLevels > 0 && edgesAt(remainingLevels) is [var only];
            collapsedCount++)
        {
            (map, remainingLevels) = (map * only.Map, only.RemainingLevels(remainingLevels));
        }

        return new(map, BoundingSphere.OperatorNormBound(map.Linear) * (1 + Rounding), remainingLevels);
    }
}
