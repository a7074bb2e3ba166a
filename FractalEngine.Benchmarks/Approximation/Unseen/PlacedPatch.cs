using FractalEngine.Core.Maths;

namespace FractalEngine.Benchmarks.Approximation.Unseen;

/// <summary>One unit of a model that repeats: a patch, whose border joins those of its neighbours.</summary>
/// <param name="Patch">The index of the patch.</param>
/// <param name="Map">Where it stands.</param>
internal readonly record struct PlacedPatch(int Patch, AffineMap Map);
