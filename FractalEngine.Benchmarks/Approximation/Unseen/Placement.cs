using FractalEngine.Core.Maths;

namespace FractalEngine.Benchmarks.Approximation.Unseen;

/// <summary>One instance of a base in an expanded fractal.</summary>
/// <param name="Map">Where it stands.</param>
/// <param name="Base">The index of the base.</param>
internal readonly record struct Placement(AffineMap Map, int Base);
