using FractalEngine.Core.Maths;

namespace FractalEngine.Benchmarks.Approximation.Unseen;

/// <summary>One of the maps that a model was made by, for descriptions; a search need not find the same ones.</summary>
/// <param name="Name">Its name in the description of the model.</param>
/// <param name="Map">The map, in the frame of the model.</param>
internal readonly record struct Generator(string Name, AffineMap Map);
