using FractalEngine.Core.Collision.Fractals;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Collision;

/// <content>Questions about two shapes.</content>
public abstract partial class Collider
{
    /// <summary>Finds the closest points of this shape and another one.</summary>
    /// <param name="other">The collider of the other shape; may be this one.</param>
    /// <param name="placementOfOther">Maps the other shape's frame to this one's, finite; may stretch, skew or flatten.</param>
    /// <param name="context">Receives the costs; null where they don't matter.</param>
    /// <returns>
    /// Both points in this shape's frame. Shapes whose faces meet have the distance 0, to rounding. A shape inside another one has not:
    /// only faces count.
    /// </returns>
    /// <exception cref="ArgumentOutOfRangeException">The placement is not finite.</exception>
    /// <exception cref="InvalidOperationException">A shape has no faces.</exception>
    /// <exception cref="FractalLimitException">The distance is beyond the range of a double.</exception>
    /// <exception cref="NotSupportedException">A collider is not exact.</exception>
    /// <remarks>
    /// The search takes about a million bounds at most, a second or so. Then <see cref="ClosestPair.ErrorBound"/> tells how much closer the
    /// shapes may be.
    /// </remarks>
    public ClosestPair FindClosestPair(Collider other, AffineMap placementOfOther, QueryContext? context = null)
    {
        ArgumentNullException.ThrowIfNull(other);
        if (!placementOfOther.IsFinite())
        {
            throw new ArgumentOutOfRangeException(nameof(placementOfOther), placementOfOther, "expected finite numbers");
        }

        return FindClosestPair(AffineMap.Identity, other, placementOfOther, context);
    }

    /// <summary>Finds the closest points of two shapes under maps to the frame of the query.</summary>
    internal ClosestPair FindClosestPair(AffineMap placement, Collider other, AffineMap placementOfOther, QueryContext? context)
    {
        var tree = ShapeTree;
        var otherTree = other.ShapeTree;
        if (tree.IsEmpty || otherTree.IsEmpty)
        {
            throw new InvalidOperationException("a shape has no faces, so no points of the two are closest");
        }

        var scale = QueryScale.Of(Math.Max(
            tree.Box.Transform(placement).MaxAbsCoordinate(),
            otherTree.Box.Transform(placementOfOther).MaxAbsCoordinate()));
        var pair = ClosestPairSearch.Run(
            tree, Scaling(scale) * placement, otherTree, Scaling(scale) * placementOfOther, (context ?? new()).Statistics);
        return scale == 1 ? pair : pair with
        {
            Distance = pair.Distance / scale,
            Point = pair.Point / scale,
            OtherPoint = pair.OtherPoint / scale,
            ErrorBound = pair.ErrorBound / scale,
        };
    }
}
