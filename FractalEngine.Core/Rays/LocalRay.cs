using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Rays;

/// <summary>
/// A ray in the frame of a sub-fractal or of a mesh. Affine maps keep the parameter along it, so distances need no conversion. It starts
/// near the bounds of what is searched, so that its coordinates are no larger than those of its targets.
/// </summary>
internal readonly struct LocalRay
{
    // An upper bound of the rounding error of one map, as a part of the largest coordinate.
    private const double MapError = 1e-15;

    /// <summary>Creates a ray.</summary>
    /// <param name="origin">Where it starts in this frame: x, y, z, 0.</param>
    /// <param name="direction">The image of the unit direction: x, y, z, 0.</param>
    /// <param name="start">Distance of the origin along the ray of the query.</param>
    /// <param name="error">How far rounding may have moved the origin, in this frame.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public LocalRay(Vector256<double> origin, Vector256<double> direction, double start, double error)
    {
        Origin = origin;
        Direction = direction;
        Start = start;
        Error = error;
    }

    /// <summary>Creates the ray of a query.</summary>
    /// <param name="origin">In the frame of the query.</param>
    /// <param name="unitDirection">Of length 1.</param>
    /// <param name="start">Distance at which it starts.</param>
    public static LocalRay Of(Vector origin, Vector unitDirection, double start)
    {
        var ray = new LocalRay(SimdAffineMap.ToVector256(origin), SimdAffineMap.ToVector256(unitDirection), 0, 0).Advance(start);
        return new(ray.Origin, ray.Direction, start, MapError * (origin.MaxAbsComponent() + start));
    }

    /// <summary>Where it starts in this frame: x, y, z, 0.</summary>
    public Vector256<double> Origin { get; }

    /// <summary>The image of the unit direction: x, y, z, 0.</summary>
    public Vector256<double> Direction { get; }

    /// <summary>Distance of the origin along the ray of the query.</summary>
    public double Start { get; }

    /// <summary>How far rounding may have moved the origin, in this frame.</summary>
    public double Error { get; }

    /// <summary>The largest absolute component of the direction.</summary>
    public double Speed
    {
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        get => MaxComponent(Vector256.Abs(Direction));
    }

    /// <summary>Maps the ray to another frame.</summary>
    /// <param name="map">From this frame to the other one.</param>
    /// <param name="norm">Upper bound of the factor by which the map lengthens vectors.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public LocalRay Transform(in SimdAffineMap map, double norm)
    {
        var origin = map.Apply(Origin);
        return new(origin, map.ApplyLinear(Direction), Start, (norm * Error) + (MapError * MaxComponent(Vector256.Abs(origin))));
    }

    /// <summary>The same ray from a later origin.</summary>
    /// <param name="distance">How much later it starts, not negative.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public LocalRay Advance(double distance) =>
        new(Origin + (Vector256.Create(distance) * Direction), Direction, Start + distance, Error);

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private static double MaxComponent(Vector256<double> v) => Math.Max(Math.Max(v[0], v[1]), v[2]);
}
