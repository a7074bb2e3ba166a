namespace FractalEngine.Core.Bvh.Splitting;

/// <summary>A run of triangles that becomes one child of a node while a bounding volume hierarchy is built.</summary>
/// <param name="Start">Place of the first triangle.</param>
/// <param name="Count">Number of triangles in the run.</param>
/// <param name="Bounds">Contains all triangles.</param>
/// <param name="DoubledCentreBounds">Contains the doubled centres of all triangles.</param>
internal readonly record struct TriangleRange(int Start, int Count, SimdBoundingBox Bounds, SimdBoundingBox DoubledCentreBounds);
