using System.Runtime.CompilerServices;
using System.Runtime.InteropServices;
using System.Runtime.Intrinsics;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Collision;

/// <summary>Distances to the images of boxes under any map, four at a time: to the boxes around the images.</summary>
internal static class ImageDistances
{
    /// <summary>The squared distances of boxes, then keys to order them by, then zeros.</summary>
    /// <param name="rows">As in <see cref="SubFractal.Bounds"/>.</param>
    /// <param name="padded">The length of a row.</param>
    /// <param name="position">In the frame of the images.</param>
    /// <param name="map">To the frame of the images.</param>
    /// <param name="results">[3 × padded].</param>
    public static void Measure(double[] rows, int padded, in Vector position, in AffineMap map, Span<double> results)
    {
        ref var row = ref MemoryMarshal.GetArrayDataReference(rows);
        ref var result = ref MemoryMarshal.GetReference(results);
        var offset = VectorQuartet.All(position - map.Translation);
        var (v1, v2, v3) = (VectorQuartet.All(map.Linear.V1), VectorQuartet.All(map.Linear.V2), VectorQuartet.All(map.Linear.V3));
        var (half, weight) = (Vector256.Create(0.5), Vector256.Create(FractalSearch.CentreWeight));
        for (var i = 0; i < padded; i += SubFractal.Lanes)
        {
            var (minimum, maximum) = (VectorQuartet.Load(ref row, i, padded), VectorQuartet.Load(ref row, (3 * padded) + i, padded));
            var (centre, halfSize) = (half * (minimum + maximum), half * (maximum - minimum));
            var away = offset - ((centre.X * v1) + (centre.Y * v2) + (centre.Z * v3));
            var squared = Beyond(away, halfSize, v1, v2, v3);
            // What stands for no box has NaN as its centre, and must be farther than anything.
            squared = Vector256.ConditionalSelect(Vector256.Equals(squared, squared), squared, Vector256.Create(double.PositiveInfinity));
            squared.StoreUnsafe(ref result, (nuint)i);
            (squared + (weight * away.LengthSquared())).StoreUnsafe(ref result, (nuint)(padded + i));
            Vector256<double>.Zero.StoreUnsafe(ref result, (nuint)((2 * padded) + i));
        }
    }

    /// <summary>The squared distances to boxes around the images of boxes.</summary>
    /// <param name="away">From the images of their centres.</param>
    /// <param name="halfSize">Of the boxes.</param>
    /// <param name="v1">The map's first column.</param>
    /// <param name="v2">The second.</param>
    /// <param name="v3">The third.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector256<double> Beyond(VectorQuartet away, VectorQuartet halfSize, VectorQuartet v1, VectorQuartet v2, VectorQuartet v3)
    {
        var reach = (halfSize.X * v1.Absolute()) + (halfSize.Y * v2.Absolute()) + (halfSize.Z * v3.Absolute());
        return VectorQuartet.Max(away.Absolute() - reach, VectorQuartet.Zero).LengthSquared();
    }
}
