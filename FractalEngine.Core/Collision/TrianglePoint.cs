using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Collision;

/// <summary>The point of a face nearest to a position.</summary>
/// <param name="Point">In the frame of the face.</param>
/// <param name="DistanceSquared">From the position; 0 on the face.</param>
/// <param name="Barycentrics">Weights of the corners a, b and c: not negative, their sum is 1.</param>
/// <param name="Feature">Where on the face it is.</param>
public readonly record struct TrianglePoint(Vector Point, double DistanceSquared, Vector Barycentrics, TriangleFeature Feature);
