using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Bvh.Boxes;

/// <summary>Computes squared distances to boxes, four at a time.</summary>
internal static class BoxDistance
{
    /// <summary>Computes the squared distances of a position from four boxes.</summary>
    /// <param name="rows">
    /// The boxes, [6 × <paramref name="paddedCount"/>]: x, y, z of the centres, then of half the sizes.
    /// </param>
    /// <param name="paddedCount">Number of boxes in each row, including padding.</param>
    /// <param name="first">Index of the first of the four.</param>
    /// <param name="position">In the frame of the boxes.</param>
    /// <param name="centreDistances">Squared distances of the boxes' centres.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector256<double> SquaredX4(
        ref double rows, int paddedCount, int first, VectorX4 position, out Vector256<double> centreDistances)
    {
        var fromCentre = (position - VectorX4.Load(ref rows, first, paddedCount)).Absolute();
        centreDistances = fromCentre.LengthSquared();
        var halfSize = VectorX4.Load(ref rows, (3 * paddedCount) + first, paddedCount);
        return VectorX4.MaxNative(fromCentre - halfSize, VectorX4.Zero).LengthSquared();
    }
}
