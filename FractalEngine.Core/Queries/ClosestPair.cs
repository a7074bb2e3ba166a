using System.Collections.Immutable;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Queries;

/// <summary>The closest points of two shapes.</summary>
/// <param name="Distance">Distance of the points, scene units; 0 where the shapes meet.</param>
/// <param name="Point">The point of the first shape.</param>
/// <param name="OtherPoint">The point of the second shape, in the same frame.</param>
/// <param name="FaceIndex">Index of the first shape's face in its mesh, from 0.</param>
/// <param name="OtherFaceIndex">Index of the second shape's face in its mesh, from 0.</param>
/// <param name="InstancePath">The first shape's instance, as in <see cref="ClosestHit.InstancePath"/>; empty for a mesh.</param>
/// <param name="OtherInstancePath">The second shape's instance; empty for a mesh.</param>
/// <param name="ErrorBound">
/// Upper bound of how much larger the distance is than that of the shapes, scene units: rounding, and what a search left open that met its
/// limit of work.
/// </param>
public sealed record ClosestPair(
    double Distance, Vector Point, Vector OtherPoint, int FaceIndex, int OtherFaceIndex, ImmutableArray<int> InstancePath,
    ImmutableArray<int> OtherInstancePath, double ErrorBound)
{
    /// <summary>Tells whether all numbers of both pairs are equal, the paths included.</summary>
    public bool Equals(ClosestPair? other) =>
        other is not null && Distance.Equals(other.Distance) && Point == other.Point && OtherPoint == other.OtherPoint
        && FaceIndex == other.FaceIndex && OtherFaceIndex == other.OtherFaceIndex && ErrorBound.Equals(other.ErrorBound)
        && InstancePath.AsSpan().SequenceEqual(other.InstancePath.AsSpan())
        && OtherInstancePath.AsSpan().SequenceEqual(other.OtherInstancePath.AsSpan());

    /// <inheritdoc/>
    public override int GetHashCode() => HashCode.Combine(Distance, Point, OtherPoint, FaceIndex, OtherFaceIndex);
}
