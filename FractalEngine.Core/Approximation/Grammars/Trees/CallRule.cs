using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Approximation.Grammars.Trees;

/// <summary>One call of a recursive by another one.</summary>
/// <param name="Caller">The index of the recursive that calls; 0 is that of the whole.</param>
/// <param name="Map">The map that the call stands behind, in the frame of the caller.</param>
/// <param name="Called">The index of the recursive that is called.</param>
internal readonly record struct CallRule(int Caller, AffineMap Map, int Called);
