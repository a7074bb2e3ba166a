using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;

namespace FractalEngine.Core.Geometry.Rays;

/// <summary>
/// A ray in single precision, for tests of many bounds at once. Lengths are in units of what is searched, and the direction is of about
/// the length 1.
/// </summary>
internal readonly struct FloatRay
{
    /// <summary>
    /// What bounds are widened by so that rounding hides nothing, as a part of the size of what is searched: docs/rays.md.
    /// </summary>
    public const float Margin = 4e-6f;

    // Smaller components are this: over the length of what is searched, they matter less than the margin.
    private const float MinComponent = 1e-12f;

    // An origin that rounding has left so far away is anywhere as well, and its widening reaches all bounds. Absent children of a node
    // have infinite bounds: beside these all must stay finite, the products with inverse components included.
    private const float MaxOrigin = 1e18f;
    private const float MaxWidening = 1e19f;

    // What rounding takes from a parameter and its key, as a factor.
    private const double LimitFactor = 1 + 1e-5;

    /// <summary>Converts a ray to floats.</summary>
    /// <param name="ray">Starts within a few units of the centre.</param>
    /// <param name="speed">About the length of its direction.</param>
    /// <param name="inverseSpeed">The inverse of that.</param>
    /// <param name="centre">Origin of the float coordinates: x, y, z, 0.</param>
    /// <param name="inverseSize">Inverse of the unit of length.</param>
    /// <param name="search">The limit of the search, and its rounding.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public FloatRay(
        in LocalRay ray, double speed, double inverseSpeed, Vector256<double> centre, double inverseSize, in RaySearch search)
    {
        PerDistance = speed * inverseSize;
        Limit = LimitFor(in ray, PerDistance, search.MaxDistance);
        Widening = Math.Min(MaxWidening, Margin + (float)(ray.InverseScale * inverseSize * search.Error));
        var narrow = Vector256.Narrow(
            (ray.Origin - centre) * Vector256.Create(inverseSize), ray.Direction * Vector256.Create(inverseSpeed));
        Origin = Vector128.Min(Vector128.Max(narrow.GetLower(), Vector128.Create(-MaxOrigin)), Vector128.Create(MaxOrigin));
        Direction = WithoutZeros(narrow.GetUpper());
        InverseDirection = Vector128<float>.One / Direction;
    }

    /// <summary>Where it starts: x, y, z and any fourth lane.</summary>
    public Vector128<float> Origin { get; }

    /// <summary>Its direction without components of 0.</summary>
    public Vector128<float> Direction { get; }

    /// <summary>Inverses of the components of the direction.</summary>
    public Vector128<float> InverseDirection { get; }

    /// <summary>Factor from distances along the ray of the query to the parameter of this one.</summary>
    public double PerDistance { get; }

    /// <summary>Largest parameter that counts.</summary>
    public float Limit { get; }

    /// <summary>What bounds are widened by on all sides.</summary>
    public float Widening { get; }

    /// <summary>Converts a distance along the ray of the query to an upper bound of the parameter.</summary>
    /// <param name="ray">The ray.</param>
    /// <param name="perDistance">See <see cref="PerDistance"/>.</param>
    /// <param name="distance">The distance.</param>
    public static float LimitFor(in LocalRay ray, double perDistance, double distance) => LimitFor(ray.Start, perDistance, distance);

    /// <summary>Converts a distance along the ray of the query to an upper bound of the parameter.</summary>
    /// <param name="start">Distance of the origin along the ray of the query.</param>
    /// <param name="perDistance">See <see cref="PerDistance"/>.</param>
    /// <param name="distance">The distance.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static float LimitFor(double start, double perDistance, double distance) =>
        (float)((distance - start) * perDistance * LimitFactor) + Margin;

    /// <summary>Replaces components of a direction that are nearly 0, so that all have an inverse. Signs stay.</summary>
    /// <param name="direction">The direction, of about the length 1.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector128<float> WithoutZeros(Vector128<float> direction)
    {
        var isTiny = Vector128.LessThan(Vector128.Abs(direction), Vector128.Create(MinComponent));
        return Vector128.ConditionalSelect(isTiny, Vector128.Create(MinComponent) | (direction & Vector128.Create(-0f)), direction);
    }
}
