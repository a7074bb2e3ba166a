namespace FractalEngine.Core.Scenes;

/// <summary>A number that goes evenly from one end of a gradient to the other.</summary>
/// <param name="First">At the beginning of the gradient.</param>
/// <param name="Last">At its end.</param>
public readonly record struct GradientRange(double First, double Last)
{
    /// <summary>The number at a position in the gradient.</summary>
    /// <param name="factor">From 0 to 1.</param>
    public double At(double factor) => First + (factor * (Last - First));
}
