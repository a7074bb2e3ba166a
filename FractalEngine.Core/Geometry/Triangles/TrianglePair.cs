using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Geometry.Triangles;

/// <summary>The closest points of two triangles.</summary>
/// <param name="Point1">The point of the first triangle.</param>
/// <param name="Point2">The point of the second triangle.</param>
/// <param name="DistanceSquared">Their squared distance; 0 where the triangles meet.</param>
internal readonly record struct TrianglePair(Vector Point1, Vector Point2, double DistanceSquared);
