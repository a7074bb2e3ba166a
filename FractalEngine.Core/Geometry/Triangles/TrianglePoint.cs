using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Geometry.Triangles;

/// <summary>The point of a triangle that is closest to a position.</summary>
/// <param name="Point">The point in the frame of the triangle.</param>
/// <param name="DistanceSquared">Squared distance from the position; 0 on the triangle.</param>
/// <param name="Barycentrics">Weights of the vertices a, b and c: not negative, with the sum 1.</param>
/// <param name="Feature">The part of the triangle that the point lies on.</param>
public readonly record struct TrianglePoint(Vector Point, double DistanceSquared, Vector Barycentrics, TriangleFeature Feature);
