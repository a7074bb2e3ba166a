using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Generation;

/// <summary>A coordinate frame on a wall: two perpendicular unit vectors along it, and <see cref="Out"/> away from it.</summary>
/// <param name="Origin">Origin of the frame, world space.</param>
/// <param name="Right">First axis, along the wall.</param>
/// <param name="Up">Second axis, along the wall and perpendicular to the first.</param>
internal readonly record struct WallFrame(Vector Origin, Vector Right, Vector Up)
{
    /// <summary>Third axis, away from the wall and into the room.</summary>
    public Vector Out => Vector.Cross(Right, Up);

    /// <summary>Computes a point from its coordinates along the wall and its height above it.</summary>
    public Vector At(double x, double y, double height = 0) => Origin + (x * Right) + (y * Up) + (height * Out);

    /// <summary>Moves the frame along the wall and away from it.</summary>
    public WallFrame Translated(double x, double y, double height = 0) => this with { Origin = At(x, y, height) };
}
