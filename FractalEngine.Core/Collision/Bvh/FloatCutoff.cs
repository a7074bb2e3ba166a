using System.Runtime.CompilerServices;

namespace FractalEngine.Core.Collision.Bvh;

/// <summary>
/// Computes the limit for squared distances in single precision from the smallest of them. What is not below it is farther than the
/// closest triangle even in double precision.
/// </summary>
/// <remarks>
/// All lengths are in the boxes' units. A distance d comes out wrong by at most u·(Representation·(P + 2) + Arithmetic·(d + E)) + δ. Here
/// u is half a last place, P the largest coordinate of the position, E the longest edge, and δ the rounding of the kernel. The proof is in
/// docs/colliders.md.
/// </remarks>
internal readonly struct FloatCutoff
{
    /// <summary>Half the relative distance of two floats.</summary>
    public const double UnitRoundoff = 1.0 / (1 << 24);

    // √3, for the rounding of a position and of a foot, and a little for what is small of second order.
    private const double RepresentationError = 1.8;

    // What the sums and products of TriangleFrames add, in units of the distance from the foot.
    private const double ArithmeticError = 32;

    private readonly float _factor;
    private readonly float _summand;

    private FloatCutoff(float factor, float summand)
    {
        _factor = factor;
        _summand = summand;
    }

    /// <summary>Computes the coefficients of the limit for a position.</summary>
    /// <param name="maxCoordinate">Largest coordinate of the position.</param>
    /// <param name="longestEdge">Longest edge of the mesh.</param>
    /// <param name="kernelError">An upper bound of the rounding of the kernel's distances.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static FloatCutoff Create(double maxCoordinate, double longestEdge, double kernelError) => new(
        // Once for the closest triangle and once for the other, and a little for terms of second order.
        (float)(1 + (2.1 * ArithmeticError * UnitRoundoff)), (float)(2.1 * ErrorBound(maxCoordinate, longestEdge, kernelError, 0)));

    /// <summary>An upper bound of the error of a distance in single precision.</summary>
    /// <param name="maxCoordinate">Largest coordinate of the position.</param>
    /// <param name="longestEdge">Longest edge of the mesh.</param>
    /// <param name="kernelError">An upper bound of the rounding of the kernel's distances.</param>
    /// <param name="distance">The distance.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static double ErrorBound(double maxCoordinate, double longestEdge, double kernelError, double distance) =>
        (UnitRoundoff * ((RepresentationError * (maxCoordinate + 2)) + (ArithmeticError * (distance + longestEdge)))) + kernelError;

    /// <summary>Computes the limit of squared distances, exclusive.</summary>
    /// <param name="distanceSquared">Smallest squared distance in single precision.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public float For(float distanceSquared)
    {
        var cutoff = (MathF.Sqrt(distanceSquared) * _factor) + _summand;
        return cutoff * cutoff;
    }
}
