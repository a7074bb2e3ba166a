using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Geometry.Hulls;

/// <summary>A triangle of a hull's surface, by the coordinates of its corners.</summary>
internal readonly record struct HullFacet(Vector A, Vector B, Vector C);
