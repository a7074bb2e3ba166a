using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Approximation.Damaged;

/// <summary>A map that takes elements to elements.</summary>
/// <param name="Map">The map.</param>
/// <param name="Support">How many it takes to others, each counted by the weights of both.</param>
internal readonly record struct Relation(AffineMap Map, double Support);
