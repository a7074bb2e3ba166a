namespace FractalEngine.Tests.Rays;

/// <summary>Where a ray crosses a triangle, and how certain that is.</summary>
/// <param name="Inside">How far inside the triangle the ray passes, measured across the ray; negative infinity for a miss.</param>
/// <param name="Distance">Distance along the ray.</param>
/// <param name="Tolerance">How far off that distance may be; more for a grazing ray.</param>
/// <param name="Reach">Largest absolute coordinate on the way.</param>
internal readonly record struct TriangleCrossing(double Inside, double Distance, double Tolerance, double Reach)
{
    /// <summary>True where no rounding of corners can turn the hit into a miss.</summary>
    public bool IsCertain => Inside > ProjectedRay.CornerError * Reach;

    /// <summary>True where the hit certainly lies between two distances.</summary>
    public bool IsCertainlyWithin(double minDistance, double maxDistance) =>
        IsCertain && Distance >= minDistance + Tolerance && Distance <= maxDistance - Tolerance;
}
