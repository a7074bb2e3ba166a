using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Visibility;

/// <summary>How a scene is looked at, as far as it matters for what is to be drawn.</summary>
/// <param name="Position">Of the camera, world space.</param>
/// <param name="Axes">Columns: its right, up and forward axes in world space.</param>
/// <param name="IsPerspective">Else orthographic.</param>
/// <param name="HalfHeight">Half of what the picture shows: at depth 1 in perspective, in scene units otherwise.</param>
/// <param name="Width">Of the picture, pixels.</param>
/// <param name="Height">Of the picture, pixels.</param>
/// <param name="Aspect">Width divided by height of what the picture shows.</param>
/// <param name="Near">Nothing nearer is drawn: depth, scene units; above 0 in perspective.</param>
/// <param name="Far">Nothing farther is drawn.</param>
public readonly record struct CullingView(
    Vector Position, Matrix Axes, bool IsPerspective, double HalfHeight, int Width, int Height, double Aspect, double Near, double Far)
{
    /// <summary>Pixels from the middle of the picture to the right, per unit to the right (at depth 1 in perspective).</summary>
    public double PixelsPerUnitX => 0.5 * Width / (HalfHeight * Aspect);

    /// <summary>The same upwards.</summary>
    public double PixelsPerUnitY => 0.5 * Height / HalfHeight;
}
