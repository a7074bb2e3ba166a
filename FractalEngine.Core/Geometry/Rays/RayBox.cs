using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Geometry.Rays;

/// <summary>A box that rays approach from afar, in double precision.</summary>
internal sealed class RayBox
{
    // Farther away, in half sizes, floats tell bounds apart less well than rounding allows.
    private const double MaxOriginDistance = 4;

    private const double MinRelativeComponent = 1e-30;

    private readonly Vector256<double> _halfSize;

    /// <summary>Prepares a box, which is not empty.</summary>
    public RayBox(BoundingBox box)
    {
        var halfSize = 0.5 * box.Size;
        var error = RoundingErrors.Chain * box.MaxAbsCoordinate();
        var size = Math.Max(halfSize.MaxAbsComponent(), error);
        InverseHalfExtent = size > 0 ? 1 / size : 1;
        HalfExtent = 1 / InverseHalfExtent;
        Centre = SimdAffineMap.ToVector256(box.Centre);
        _halfSize = SimdAffineMap.ToVector256(halfSize + (error * Vector.One));
    }

    /// <summary>The centre: x, y, z, 0.</summary>
    public Vector256<double> Centre { get; }

    /// <summary>Half the largest side.</summary>
    public double HalfExtent { get; }

    /// <summary>Inverse of half the largest side.</summary>
    public double InverseHalfExtent { get; }

    /// <summary>Maps the frame of the box to its units: half the largest side, from the centre.</summary>
    public AffineMap ToUnits =>
        new(InverseHalfExtent * Matrix.Identity, -InverseHalfExtent * SimdAffineMap.ToVector(Centre));

    /// <summary>Maps the units of the box to its frame.</summary>
    public AffineMap FromUnits => new(HalfExtent * Matrix.Identity, SimdAffineMap.ToVector(Centre));

    /// <summary>Finds where a ray enters a box.</summary>
    /// <param name="box">In the frame of the ray.</param>
    /// <param name="ray">The ray.</param>
    /// <returns>The distance from its origin, 0 within the box; infinite where the ray misses it.</returns>
    public static double FindEntry(BoundingBox box, in LocalRay ray)
    {
        var (origin, direction) = (SimdAffineMap.ToVector(ray.Origin), SimdAffineMap.ToVector(ray.Direction));
        var least = MinRelativeComponent * direction.MaxAbsComponent();
        var (near, far) = (0.0, double.PositiveInfinity);
        Clip(box.Minimum.X - origin.X, box.Maximum.X - origin.X, direction.X, least, ref near, ref far);
        Clip(box.Minimum.Y - origin.Y, box.Maximum.Y - origin.Y, direction.Y, least, ref near, ref far);
        Clip(box.Minimum.Z - origin.Z, box.Maximum.Z - origin.Z, direction.Z, least, ref near, ref far);
        return near <= far ? near : double.PositiveInfinity;
    }

    private static void Clip(double minimum, double maximum, double component, double least, ref double near, ref double far)
    {
        var inverse = 1 / (Math.Abs(component) < least ? double.CopySign(least, component) : component);
        near = Math.Max(near, inverse > 0 ? minimum * inverse : maximum * inverse);
        far = Math.Min(far, inverse > 0 ? maximum * inverse : minimum * inverse);
    }

    /// <summary>Moves the origin of a ray to where it may enter the box, if it is far away.</summary>
    /// <param name="ray">In the frame of the box.</param>
    /// <param name="search">The limit of the search, and its rounding.</param>
    /// <returns>False where a ray from afar misses the box.</returns>
    public bool TryApproach(ref LocalRay ray, in RaySearch search)
    {
        var approach = FindApproach(in ray, in search);
        if (approach is > 0 and < double.PositiveInfinity)
        {
            ray = ray.Advance(approach);
        }

        return approach < double.PositiveInfinity;
    }

    /// <summary>Finds how far a ray may advance before it enters the box, if it is far away.</summary>
    /// <param name="ray">In the frame of the box.</param>
    /// <param name="search">The limit of the search, and its rounding.</param>
    /// <returns>The distance, 0 near the box; infinite where a ray from afar misses it.</returns>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public double FindApproach(in LocalRay ray, in RaySearch search)
    {
        var distance = Vector256.Abs(ray.Origin - Centre) * Vector256.Create(InverseHalfExtent);
        return Vector256.LessThanAll(distance, Vector256.Create(MaxOriginDistance)) ? 0 : FindApproachFromAfar(in ray, in search);
    }

    [MethodImpl(MethodImplOptions.NoInlining)]
    private double FindApproachFromAfar(in LocalRay ray, in RaySearch search)
    {
        var least = Vector256.Create(MinRelativeComponent * ray.Speed);
        var isTiny = Vector256.LessThan(Vector256.Abs(ray.Direction), least);
        var direction = Vector256.ConditionalSelect(isTiny, least | (ray.Direction & Vector256.Create(-0.0)), ray.Direction);
        var inverse = Vector256<double>.One / direction;
        var toCentre = (Centre - ray.Origin) * inverse;
        var origin = Vector256.Abs(ray.Origin);
        var error = (ray.InverseScale * search.Error) + (RoundingErrors.Chain * (origin[0] + origin[1] + origin[2]));
        var half = (_halfSize + Vector256.Create(error)) * Vector256.Abs(inverse);
        var near = toCentre - half;
        var far = toCentre + half;
        var entry = Math.Max(Math.Max(near[0], near[1]), near[2]);
        var exit = Math.Min(Math.Min(far[0], far[1]), far[2]);
        return entry <= exit && exit >= 0 && entry + ray.Start <= search.MaxDistance ? Math.Max(entry, 0) : double.PositiveInfinity;
    }
}
