using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Distances;

/// <summary>How far the points of one surface are from another surface. All distances are in scene units.</summary>
/// <param name="MaxDistance">
/// Bounds of the largest distance, the one-sided Hausdorff distance. They are proved, rounding included: no sampling is involved.
/// </param>
/// <param name="Point">The point of the one surface whose distance is the lower bound.</param>
/// <param name="ClosestPoint">The point of the other surface closest to it.</param>
/// <param name="MeanDistance">The mean distance over the area; over the faces, each the same, where none has an area.</param>
/// <param name="MeanDistanceError">
/// An estimate of how far the mean may be off: what two rules of integration differ by on the triangles that are sampled, summed without
/// signs. What is smaller than these triangles may be missed.
/// </param>
/// <param name="MeanNormalAngle">
/// Mean over the area of the angle between a face and the closest face of the other surface, radians from 0 to π/2. Sides are not told
/// apart, since faces may be flipped. Sampled, without a bound.
/// </param>
public sealed record OneSidedDistance(
    DistanceInterval MaxDistance, Vector Point, Vector ClosestPoint, double MeanDistance, double MeanDistanceError, double MeanNormalAngle)
{
    /// <summary>The same with all lengths divided by a number.</summary>
    internal OneSidedDistance DividedBy(double scale) => this with
    {
        MaxDistance = new(MaxDistance.Lower / scale, MaxDistance.Upper / scale),
        Point = Point / scale,
        ClosestPoint = ClosestPoint / scale,
        MeanDistance = MeanDistance / scale,
        MeanDistanceError = MeanDistanceError / scale,
    };
}
