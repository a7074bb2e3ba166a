namespace FractalEngine.Benchmarks.Measuring;

/// <summary>
/// How wrong distances are. Parts of the size are of the shape's diagonal; relative errors are parts of the right distance.
/// </summary>
/// <param name="Max">Of the size.</param>
/// <param name="Mean">Of the size.</param>
/// <param name="MaxRelative">What ε bounds.</param>
/// <param name="MeanRelative">Of all positions.</param>
/// <param name="MissedPercent">
/// Positions within <see cref="TouchDistance"/> of the shape for which the collider says that they are not.
/// </param>
internal readonly record struct DistanceErrors(double Max, double Mean, double MaxRelative, double MeanRelative, double MissedPercent)
{
    /// <summary>What counts as touching, as a part of the size.</summary>
    public const double TouchDistance = 0.02;

    /// <summary>What rounding may do to exact answers, as a part of the size.</summary>
    public const double RoundingTolerance = 1e-12;

    /// <summary>Compares distances with the right ones.</summary>
    /// <param name="distances">Found.</param>
    /// <param name="oracle">As many.</param>
    /// <param name="size">Diagonal of the shape.</param>
    public static DistanceErrors Compare(double[] distances, double[] oracle, double size)
    {
        var errors = distances.Zip(oracle, AbsoluteError).ToArray();
        // Where the position is on the surface, what rounding leaves is no error.
        var relative = errors.Zip(oracle, (error, expected) => error <= RoundingTolerance * size ? 0 : error / expected).ToArray();
        var missedCount = distances.Zip(oracle).Count(pair => pair.Second <= TouchDistance * size && !(pair.First <= TouchDistance * size));
        return new(errors.Max() / size, errors.Average() / size, relative.Max(), relative.Average(), 100.0 * missedCount / oracle.Length);
    }

    /// <summary>What is no number is as wrong as can be: <c>Max</c> leaves NaN out.</summary>
    private static double AbsoluteError(double distance, double expected) => Math.Abs(distance - expected) switch
    {
        double.NaN => distance == expected ? 0 : double.PositiveInfinity,
        var error => error,
    };
}
