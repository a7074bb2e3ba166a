namespace FractalEngine.Benchmarks.Measuring;

/// <summary>
/// Errors of distances. Those of the size are fractions of the shape's diagonal; relative errors are fractions of the right distance.
/// </summary>
/// <param name="Max">Largest error of the size.</param>
/// <param name="Mean">Mean error of the size.</param>
/// <param name="MaxRelative">Largest relative error, which ε bounds.</param>
/// <param name="MeanRelative">Mean relative error of all positions.</param>
/// <param name="MissedPercent">
/// Percent of the positions that are within <see cref="TouchDistance"/> of the shape though the collider says that they are not.
/// </param>
internal readonly record struct DistanceErrors(double Max, double Mean, double MaxRelative, double MeanRelative, double MissedPercent)
{
    /// <summary>Distance that counts as touching, as a fraction of the size.</summary>
    public const double TouchDistance = 0.02;

    /// <summary>Error that rounding may cause in exact results, as a fraction of the size.</summary>
    public const double RoundingTolerance = 1e-12;

    /// <summary>Compares distances with the right ones.</summary>
    /// <param name="distances">Distances that a collider found.</param>
    /// <param name="oracle">The right distances, as many.</param>
    /// <param name="size">Diagonal of the shape.</param>
    public static DistanceErrors Compare(double[] distances, double[] oracle, double size)
    {
        var errors = distances.Zip(oracle, AbsoluteError).ToArray();
        // Where the position is on the surface, what rounding leaves is no error.
        var relative = errors.Zip(oracle, (error, expected) => error <= RoundingTolerance * size ? 0 : error / expected).ToArray();
        var missedCount = distances.Zip(oracle).Count(pair => pair.Second <= TouchDistance * size && !(pair.First <= TouchDistance * size));
        return new(errors.Max() / size, errors.Average() / size, relative.Max(), relative.Average(), 100.0 * missedCount / oracle.Length);
    }

    /// <summary>Computes an error in which NaN counts as infinite, since <c>Max</c> would ignore it.</summary>
    private static double AbsoluteError(double distance, double expected)
    {
        var error = Math.Abs(distance - expected);
        return !double.IsNaN(error) ? error : distance == expected ? 0 : double.PositiveInfinity;
    }
}
