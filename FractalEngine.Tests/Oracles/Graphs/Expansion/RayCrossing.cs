namespace FractalEngine.Tests.Oracles.Graphs.Expansion;

/// <summary>How a ray passes a triangle.</summary>
/// <param name="Inside">Distance from the ray to the nearest edge, seen along the ray; negative where the ray passes outside.</param>
/// <param name="Distance">Distance along the ray.</param>
/// <param name="Tolerance">How far off that distance may be: more for a grazing ray, infinite for a triangle that is seen edge on.</param>
/// <param name="Farthest">The distance along the ray of the last corner.</param>
internal readonly record struct RayCrossing(double Inside, double Distance, double Tolerance, double Farthest)
{
    /// <summary>How far rounding may move a corner, as a part of the reach: two hundred times the last place.</summary>
    public const double CornerError = 4e-14;

    /// <summary>How far off the distance to a hit may be, as a part of the reach: what the engine promises.</summary>
    public const double DistanceError = 1e-12;

    /// <summary>True where no rounding turns the hit into a miss, or moves it behind the origin.</summary>
    public bool IsCertain(double reach) => Inside > CornerError * reach && Distance > Tolerance;

    /// <summary>True where the ray hits the triangle by the numbers as they are. Edge on, a triangle is not hit.</summary>
    public bool IsPlain(double reach) => Inside >= 0 && Distance >= 0 && Tolerance < reach;

    /// <summary>The largest distance that a hit may have.</summary>
    public double LatestDistance => Math.Min(Distance, Farthest) + Tolerance;
}
