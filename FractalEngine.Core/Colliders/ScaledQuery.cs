using System.Globalization;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Geometry.Triangles;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Queries;

namespace FractalEngine.Core.Colliders;

/// <summary>Queries of colliders in other units, and the limits of those that have none.</summary>
internal static class ScaledQuery
{
    // A sum of several coordinates of any shape, times this, is a double.
    private const double SmallestEntry = 1e-3;

    /// <summary>Answers a query in units in which the largest coordinate is about 1.</summary>
    /// <param name="collider">Supports queries under a map.</param>
    /// <param name="position">In the frame of the image.</param>
    /// <param name="map">From the shape's frame to that of the image.</param>
    /// <param name="magnitude">Largest coordinate, of which <see cref="QueryScale.IsNeeded"/> is true.</param>
    /// <param name="maxDistance">Search radius in the frame of the image.</param>
    /// <param name="epsilon">Allowed relative error.</param>
    /// <param name="context">Receives the costs and the instance.</param>
    /// <param name="closest">The closest point in the frame of the image. Its distance is infinite where it is beyond a double.</param>
    /// <exception cref="ArgumentOutOfRangeException">The position is not finite.</exception>
    /// <exception cref="FractalLimitException">The map is not finite, or no unit makes the image so.</exception>
    public static bool FindClosest(
        Collider collider, in Vector position, in AffineMap map, double magnitude, double maxDistance, double epsilon, QueryContext context,
        out ClosestPoint closest)
    {
        if (!position.IsFinite())
        {
            throw new ArgumentOutOfRangeException(nameof(position), position, "expected finite coordinates");
        }

        // The collider asks again while coordinates are out of range: each time they are smaller, or that ends here.
        if (!map.IsFinite() || (!double.IsFinite(magnitude) && IsSmallest(in position, in map)))
        {
            throw new FractalLimitException("the placement of the shape is beyond the range of a double");
        }

        // Powers of two change no digits.
        var exponent = QueryScale.Exponent(magnitude);
        var scale = Math.ScaleB(1, -exponent);
        AffineMap scaledMap = new(scale * map.Linear, scale * map.Translation);
        if (!collider.FindClosestTransformed(scale * position, scaledMap, maxDistance * scale, epsilon, context, out var scaled))
        {
            closest = default;
            return false;
        }

        closest = scaled with
        {
            Distance = Math.ScaleB(scaled.Distance, exponent),
            Point = scaled.Point / scale,
            ErrorBound = Math.ScaleB(scaled.ErrorBound, exponent),
        };
        return closest.Distance <= maxDistance;
    }

    /// <summary>Throws for a distance that is larger than any double.</summary>
    /// <exception cref="FractalLimitException">The distance is infinite.</exception>
    public static void ThrowIfInfinite(double distance)
    {
        if (double.IsPositiveInfinity(distance))
        {
            throw new FractalLimitException("the distance is beyond the range of a double");
        }
    }

    /// <summary>Throws where a collider that has no other units would compute beyond the range of a double.</summary>
    /// <param name="magnitude">Largest coordinate of a position or a shape.</param>
    /// <exception cref="FractalLimitException">It is too large; the message says how large it may be.</exception>
    public static void ThrowIfTooLarge(double magnitude)
    {
        if (magnitude > QueryScale.MaxMagnitude)
        {
            throw new FractalLimitException(string.Create(
                CultureInfo.InvariantCulture,
                $"this collider is not exact, and searches coordinates up to {QueryScale.MaxMagnitude:R} only"));
        }
    }

    /// <summary>True where the image of any finite shape is finite, so that an infinite one can't become finite in other units.</summary>
    private static bool IsSmallest(in Vector position, in AffineMap map) =>
        position.MaxAbsComponent() <= 2 && map.Translation.MaxAbsComponent() <= 2 && map.Linear.MaxAbsEntry() <= SmallestEntry;
}
