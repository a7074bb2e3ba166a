using System.Runtime.CompilerServices;

namespace FractalEngine.Core.Bvh.Boxes;

/// <summary>
/// Computes the limit for squared distances in single precision from the smallest of them. What is not below it is farther than the
/// closest triangle even in double precision.
/// </summary>
/// <remarks>
/// All lengths are in the boxes' units. The bound of the error of a distance is proved in docs/colliders.md. It counts twice: once for the
/// triangle that seems closest, and once for the one that is.
/// </remarks>
internal readonly struct FloatCutoff(float factor, float summand)
{
    /// <summary>Half the relative distance of two floats.</summary>
    public const double UnitRoundoff = 1.0 / (1 << 24);

    // √3, for the rounding of a position and of a foot, and a little for what is small of second order.
    private const double CoordinateError = 1.8;

    // The sums and products of TriangleFrames, as parts of the distance and of the longest edge.
    private const double DistanceError = 24;
    private const double EdgeError = 34;

    // The rounding of the limit itself.
    private const double LimitError = 8;

    private readonly float _factor = factor;
    private readonly float _summand = summand;

    /// <summary>Computes the coefficients of the limit for a position.</summary>
    /// <param name="maxCoordinate">Largest coordinate of the position.</param>
    /// <param name="longestEdge">Longest edge of the mesh.</param>
    /// <param name="kernelError">An upper bound of the rounding of the kernel's distances.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static FloatCutoff Create(double maxCoordinate, double longestEdge, double kernelError) => new(
        (float)(1 + (((2 * DistanceError) + LimitError) * UnitRoundoff)),
        (float)(2.1 * ErrorBound(maxCoordinate, longestEdge, kernelError, 0)));

    /// <summary>An upper bound of the error of a distance in single precision.</summary>
    /// <param name="maxCoordinate">Largest coordinate of the position.</param>
    /// <param name="longestEdge">Longest edge of the mesh.</param>
    /// <param name="kernelError">An upper bound of the rounding of the kernel's distances.</param>
    /// <param name="distance">The distance.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static double ErrorBound(double maxCoordinate, double longestEdge, double kernelError, double distance) =>
        (UnitRoundoff * ((CoordinateError * (maxCoordinate + 2)) + (DistanceError * distance) + (EdgeError * longestEdge))) + kernelError;

    /// <summary>Computes the limit of squared distances, exclusive.</summary>
    /// <param name="distanceSquared">Smallest squared distance in single precision.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public float For(float distanceSquared)
    {
        var cutoff = (MathF.Sqrt(distanceSquared) * _factor) + _summand;
        return cutoff * cutoff;
    }
}
