namespace FractalEngine.Benchmarks.Measuring;

/// <summary>
/// How wrong distances are. Parts of the size are of the shape's diagonal; relative errors are parts of the right distance.
/// </summary>
/// <param name="Largest">Of the size.</param>
/// <param name="Mean">Of the size.</param>
/// <param name="LargestRelative">What ε bounds.</param>
/// <param name="MeanRelative">Of all positions.</param>
/// <param name="MissedPercent">Positions within <see cref="Reach"/> of the shape for which the collider says that they are not.</param>
internal readonly record struct AnswerErrors(double Largest, double Mean, double LargestRelative, double MeanRelative, double MissedPercent)
{
    /// <summary>What counts as touching, as a part of the size.</summary>
    public const double Reach = 0.02;

    /// <summary>What rounding may do to exact answers, as a part of the size.</summary>
    public const double Rounding = 1e-12;

    /// <summary>Compares distances with the right ones.</summary>
    /// <param name="distances">Found.</param>
    /// <param name="oracle">As many.</param>
    /// <param name="size">Diagonal of the shape.</param>
    public static AnswerErrors Of(double[] distances, double[] oracle, double size)
    {
        var errors = distances.Zip(oracle, Error).ToArray();
        // Where the position is on the surface, what rounding leaves is no error.
        var relative = errors.Zip(oracle, (error, right) => error <= Rounding * size ? 0 : error / right).ToArray();
        var missed = distances.Zip(oracle).Count(pair => pair.Second <= Reach * size && !(pair.First <= Reach * size));
        return new(errors.Max() / size, errors.Average() / size, relative.Max(), relative.Average(), 100.0 * missed / oracle.Length);
    }

    /// <summary>What is no number is as wrong as can be: <c>Max</c> leaves NaN out.</summary>
    private static double Error(double distance, double right) => Math.Abs(distance - right) switch
    {
        double.NaN => distance == right ? 0 : double.PositiveInfinity,
        var error => error,
    };
}
