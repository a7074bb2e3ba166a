using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Visibility.Frames;

/// <summary>A camera and a frame, reduced to what decides about the visible instances.</summary>
/// <param name="Position">Camera position, world space.</param>
/// <param name="Axes">Columns are the camera's right, up and forward axes in world space.</param>
/// <param name="IsPerspective">True for a perspective projection, false for an orthographic one.</param>
/// <param name="HalfHeight">Half the height that the frame shows: at depth 1 in perspective, in scene units otherwise.</param>
/// <param name="Width">Width of the frame, pixels.</param>
/// <param name="Height">Height of the frame, pixels.</param>
/// <param name="Aspect">Width divided by height of what the frame shows.</param>
/// <param name="Near">Depth of the near plane, scene units; above 0 in perspective.</param>
/// <param name="Far">Depth of the far plane, scene units; may be infinite.</param>
public readonly record struct CullingView(
    Vector Position, Matrix Axes, bool IsPerspective, double HalfHeight, int Width, int Height, double Aspect, double Near, double Far)
{
    /// <summary>The plane beyond which nothing is visible, in world axes about the camera; null for none.</summary>
    public SectionPlane? Section { get; init; }

    /// <summary>How far the image is moved on the screen, in pixels to the right and upwards.</summary>
    public (double X, double Y) Offset { get; init; }

    /// <summary>Pixels per scene unit to the right (at depth 1 in perspective).</summary>
    public double PixelsPerUnitX => 0.5 * Width / (HalfHeight * Aspect);

    /// <summary>Pixels per scene unit upwards (at depth 1 in perspective).</summary>
    public double PixelsPerUnitY => 0.5 * Height / HalfHeight;
}
