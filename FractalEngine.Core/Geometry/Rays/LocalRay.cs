using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Geometry.Rays;

/// <summary>
/// A ray in the frame of a sub-fractal or of a mesh. Affine maps keep the parameter along it, so distances need no conversion. It starts
/// near the bounds of what is searched, so that its coordinates are no larger than those of its targets.
/// </summary>
/// <param name="origin">Where it starts in this frame: x, y, z, 0.</param>
/// <param name="direction">The image of the unit direction: x, y, z, 0.</param>
/// <param name="start">Distance of the origin along the ray of the query.</param>
/// <param name="scale">Upper bound of the factor from lengths in this frame to those of the query.</param>
/// <param name="inverseScale">Upper bound of the factor from lengths of the query to those in this frame.</param>
[method: MethodImpl(MethodImplOptions.AggressiveInlining)]
internal readonly struct LocalRay(Vector256<double> origin, Vector256<double> direction, double start, double scale, double inverseScale)
{
    /// <summary>Where it starts in this frame: x, y, z, 0.</summary>
    public readonly Vector256<double> Origin = origin;

    /// <summary>The image of the unit direction: x, y, z, 0.</summary>
    public readonly Vector256<double> Direction = direction;

    /// <summary>Distance of the origin along the ray of the query.</summary>
    public readonly double Start = start;

    /// <summary>Upper bound of the factor from lengths in this frame to those of the query.</summary>
    public readonly double Scale = scale;

    /// <summary>Upper bound of the factor from lengths of the query to those in this frame.</summary>
    public readonly double InverseScale = inverseScale;

    /// <summary>The largest absolute component of the direction.</summary>
    public double Speed => SimdAffineMap.ToVector(Direction).MaxAbsComponent();

    /// <summary>Creates the ray of a query.</summary>
    /// <param name="origin">In the frame of the query.</param>
    /// <param name="unitDirection">The direction, of length 1.</param>
    /// <param name="start">Distance at which it starts.</param>
    public static LocalRay Of(Vector origin, Vector unitDirection, double start) =>
        new(SimdAffineMap.ToVector256(origin + (start * unitDirection)), SimdAffineMap.ToVector256(unitDirection), start, 1, 1);

    /// <summary>Maps the ray to another frame.</summary>
    /// <param name="map">From this frame to the other one.</param>
    /// <param name="norm">Upper bound of the factor by which the map lengthens vectors.</param>
    /// <param name="inverseNorm">Upper bound of the factor by which its inverse lengthens vectors.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public LocalRay Transform(in SimdAffineMap map, double norm, double inverseNorm) =>
        new(map.Apply(Origin), map.ApplyLinear(Direction), Start, Scale * inverseNorm, InverseScale * norm);

    /// <summary>The same ray from a later origin.</summary>
    /// <param name="distance">How much later it starts, not negative.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public LocalRay Advance(double distance) =>
        new(Origin + (Vector256.Create(distance) * Direction), Direction, Start + distance, Scale, InverseScale);
}
