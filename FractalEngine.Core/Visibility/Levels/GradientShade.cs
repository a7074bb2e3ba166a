using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Visibility.Levels;

/// <summary>What a gradient gives to an instance; to a proxy the mean of what its sub-fractal shows.</summary>
/// <param name="Factor">Position in the gradient, from 0 to 1.</param>
/// <param name="Colour">Colour of the palette there, linear light; black where the gradient has none.</param>
public readonly record struct GradientShade(double Factor, Vector Colour);
