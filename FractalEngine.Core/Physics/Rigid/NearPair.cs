using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Physics.Rigid;

/// <summary>Two triangles that are within the margin of a search for contacts, or two parts that contacts hold apart.</summary>
/// <param name="Node1">The first surface's part.</param>
/// <param name="Triangle1">Index of the triangle in the leaf; negative where the whole part is meant.</param>
/// <param name="Node2">The second surface's part.</param>
/// <param name="Triangle2">Index of the triangle in the leaf.</param>
/// <param name="Axis">Unit vector from the second to the first along which they are apart; zero where they cross.</param>
/// <param name="Gap">No more than how far they are apart, scene units.</param>
internal readonly record struct NearPair(int Node1, int Triangle1, int Node2, int Triangle2, Vector Axis, double Gap);
