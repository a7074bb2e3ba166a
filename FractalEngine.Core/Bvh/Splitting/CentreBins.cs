using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;

namespace FractalEngine.Core.Bvh.Splitting;

/// <summary>Divides the bounds of triangle centres into bins of equal width along each axis.</summary>
/// <param name="Minimum">The smallest doubled centre.</param>
/// <param name="Scale">Number of bins per unit along each axis; 0 for an axis without extent, which has one bin.</param>
/// <param name="LastBin">Index of the last bin along each axis.</param>
internal readonly record struct CentreBins(Vector128<float> Minimum, Vector128<float> Scale, Vector128<int> LastBin)
{
    /// <summary>Creates the bins for a range of triangles.</summary>
    /// <param name="doubledCentreBounds">Contains the doubled centres of the triangles.</param>
    /// <param name="binCount">Number of bins along each axis.</param>
    public static CentreBins Create(SimdBoundingBox doubledCentreBounds, int binCount)
    {
        var size = doubledCentreBounds.Maximum - doubledCentreBounds.Minimum;
        // The least floats would make the factor infinite.
        var isWide = Vector128.GreaterThan(size, Vector128.Create(1e-30f));
        return new(
            doubledCentreBounds.Minimum, Vector128.Create((float)binCount) / size & isWide, Vector128.Create(binCount - 1));
    }

    /// <summary>Computes the bins of a centre along x, y and z: from 0 to the last one, whatever the centre.</summary>
    /// <param name="doubledCentre">Twice the centre of a triangle's box.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public Vector128<int> IndicesOf(Vector128<float> doubledCentre) =>
        Vector128.Max(
            Vector128.Min(Vector128.ConvertToInt32Native((doubledCentre - Minimum) * Scale), LastBin), Vector128<int>.Zero);
}
