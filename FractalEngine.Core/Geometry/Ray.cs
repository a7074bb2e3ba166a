using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Geometry;

/// <summary>A half-line: where it starts, and in which direction it runs.</summary>
/// <param name="Origin">Scene units, finite.</param>
/// <param name="Direction">The finite direction, of any length but 0. Distances along the ray are in scene units whatever that is.</param>
public readonly record struct Ray(Vector Origin, Vector Direction)
{
    /// <summary>The point at a distance along the ray.</summary>
    /// <param name="distance">Scene units.</param>
    /// <exception cref="InvalidOperationException">The direction is 0.</exception>
    public Vector PointAt(double distance) => Origin + (distance * Direction.UnitVector());
}
