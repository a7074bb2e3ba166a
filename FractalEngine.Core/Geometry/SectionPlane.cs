using System.Globalization;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Geometry;

/// <summary>
/// A plane that cuts a scene open. What lies on the side that its normal points to is cut away: it is neither drawn nor hit by rays.
/// </summary>
/// <param name="Normal">Unit vector towards the side that is cut away.</param>
/// <param name="Distance">Signed distance of the plane from the origin along the normal, scene units.</param>
/// <remarks>Points of the plane itself are kept.</remarks>
public readonly record struct SectionPlane(Vector Normal, double Distance)
{
    // Distances in another unit stop here: nothing is so far away in single precision.
    private const double MaxDistance = 1e30;

    /// <summary>Whether solids are shown filled where the plane cuts them, instead of hollow.</summary>
    public bool HasCap { get; init; } = true;

    /// <summary>The same plane with the other side cut away.</summary>
    public SectionPlane Flipped => this with { Normal = Vector.Zero - Normal, Distance = 0 - Distance };

    /// <summary>Makes the plane of all points p with direction · p = offset.</summary>
    /// <param name="direction">Towards the side that is cut away, of any length but 0, finite.</param>
    /// <param name="offset">The product of points of the plane with the direction, finite.</param>
    /// <exception cref="ArgumentException">The direction is 0, or a number is not finite.</exception>
    public static SectionPlane Of(Vector direction, double offset)
    {
        var length = direction.Length();
        return length > 0 && double.IsFinite(length) && double.IsFinite(offset / length)
            ? new(direction / length, offset / length)
            : throw new ArgumentException($"expected a finite direction that is not zero and a finite offset, got {direction}, {offset}");
    }

    /// <summary>Computes how far beyond the plane a point lies: positive where it is cut away.</summary>
    /// <param name="point">In the frame of the plane.</param>
    public double SignedDistance(Vector point) => Vector.Dot(Normal, point) - Distance;

    /// <summary>Computes the plane in a frame with the same axes about an eye, in another unit.</summary>
    /// <param name="eye">Origin of the other frame.</param>
    /// <param name="unit">Length of its unit, not negative. What is too far away for single precision is moved nearer.</param>
    public SectionPlane About(Vector eye, double unit = 1)
    {
        var distance = -SignedDistance(eye);
        return this with { Distance = distance == 0 ? 0 : Math.Clamp(distance / unit, -MaxDistance, MaxDistance) };
    }

    /// <summary>Limits distances along a ray to the part of the ray that is not cut away.</summary>
    /// <param name="ray">In the frame of the plane.</param>
    /// <param name="minDistance">Smallest distance that counts; it grows where the ray enters what is kept.</param>
    /// <param name="maxDistance">Largest distance that counts; it shrinks where the ray leaves what is kept.</param>
    /// <returns>False where nothing is left of the ray.</returns>
    public bool TryClip(in Ray ray, ref double minDistance, ref double maxDistance)
    {
        var start = SignedDistance(ray.Origin);
        var slope = Vector.Dot(Normal, ray.Direction) / ray.Direction.Length();
        if (slope == 0)
        {
            return start <= 0;
        }

        var crossing = -start / slope;
        if (slope < 0)
        {
            minDistance = Math.Max(minDistance, crossing);
        }
        else
        {
            maxDistance = Math.Min(maxDistance, crossing);
        }

        return minDistance <= maxDistance;
    }

    /// <inheritdoc/>
    public override string ToString() =>
        string.Create(CultureInfo.InvariantCulture, $"{Normal} · p = {Distance:R}{(HasCap ? "" : ", hollow")}");
}
