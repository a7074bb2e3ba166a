using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Approximation.Grammars;

/// <summary>A product of sets of maps, repeated: (A·B·…)ⁿ.</summary>
/// <param name="Sets">The sets, outermost first.</param>
/// <param name="Depth">How often the product is repeated, at least 1.</param>
public sealed record GrammarStep(IReadOnlyList<IReadOnlyList<AffineMap>> Sets, int Depth);
