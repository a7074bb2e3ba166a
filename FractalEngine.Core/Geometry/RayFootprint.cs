namespace FractalEngine.Core.Geometry;

/// <summary>
/// How wide a ray is, as a pixel's is: parts of a fractal that are smaller are hit as one, their base mesh stretched to their box. Deep and
/// infinite fractals cost no more than what can be seen of them.
/// </summary>
/// <param name="Radius">Radius of the ray at its origin, scene units, not negative.</param>
/// <param name="Spread">By how much the radius grows for each unit along the ray, not negative.</param>
public readonly record struct RayFootprint(double Radius, double Spread)
{
    /// <summary>True where the ray is a line for objects with emissive faces: their parts shine by other faces than their box.</summary>
    public bool KeepsLamps { get; init; }

    /// <summary>Radius at a distance along the ray.</summary>
    /// <param name="distance">Scene units.</param>
    public double RadiusAt(double distance) => Radius + (Spread * distance);
}
