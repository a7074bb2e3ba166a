using System.Runtime.CompilerServices;

namespace FractalEngine.Core.Bvh.Boxes;

/// <summary>Computes the limit for squared bounds of boxes from the squared distance of the closest triangle.</summary>
/// <remarks>
/// With rounding, the kernel may find a triangle closer than it is by δ = 2⁻⁴⁶·magnitude, some hundred last places of its coordinates. The
/// triangle matters if its bound is below (d + δ)² ≤ (1 + s)·d² + (1 + 1/s)·δ², whatever the s.
/// </remarks>
/// <param name="factor">Factor of the squared distance.</param>
/// <param name="summand">Summand for the rounding of the kernel.</param>
internal readonly struct BoundCutoff(double factor, double summand)
{
    /// <summary>An upper bound of the kernel's error, as a part of the coordinates.</summary>
    public const double KernelError = 1.0 / (1L << 46);

    /// <summary>Computes the coefficients of the limit.</summary>
    /// <param name="scale">Boxes' units per unit of the mesh.</param>
    /// <param name="inverseBoundFactor">1 / (1 + ε)², where ε is the error that the caller allows.</param>
    /// <param name="slack">At least twice the relative error of a squared bound.</param>
    /// <param name="magnitude">Largest coordinate, in the boxes' units.</param>
    public static BoundCutoff Create(double scale, double inverseBoundFactor, double slack, double magnitude)
    {
        var rounding = magnitude * KernelError;
        return new((1 + (4 * slack)) * scale * scale * inverseBoundFactor, (1 + (1 / slack)) * rounding * rounding);
    }

    /// <summary>Computes the limit in the boxes' units: boxes with larger squared bounds contain no triangle that is closer.</summary>
    /// <param name="distanceSquared">Squared distance of the closest triangle so far, in the mesh's units.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public double For(double distanceSquared) => (distanceSquared * factor) + summand;
}
