using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Fractals.Hierarchy;

/// <summary>A triangle of a hull's surface, by the coordinates of its corners.</summary>
internal readonly record struct HullFacet(Vector A, Vector B, Vector C);
