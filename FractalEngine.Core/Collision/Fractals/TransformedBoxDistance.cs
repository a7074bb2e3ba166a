using System.Runtime.CompilerServices;
using System.Runtime.InteropServices;
using System.Runtime.Intrinsics;
using FractalEngine.Core.Collision.Bvh;

namespace FractalEngine.Core.Collision.Fractals;

/// <summary>Distances to the images of boxes under any map, four at a time: to the boxes around the images.</summary>
internal static class TransformedBoxDistance
{
    /// <summary>Queues the copies of a sub-fractal by the distances of boxes around their images.</summary>
    /// <param name="queue">Of the copies.</param>
    /// <param name="subFractal">The sub-fractal.</param>
    /// <param name="position">In the frame of the images: x, y, z, 0.</param>
    /// <param name="map">From the sub-fractal's frame to that of the images.</param>
    public static void FillQueue(ChildQueue queue, SubFractal subFractal, Vector256<double> position, in SimdAffineMap map)
    {
        var paddedCount = subFractal.PaddedCount;
        ref var rows = ref MemoryMarshal.GetArrayDataReference(subFractal.ChildBounds);
        var fromOrigin = VectorX4.Broadcast(position - map.Translation);
        var (v1, v2, v3) = (VectorX4.Broadcast(map.V1), VectorX4.Broadcast(map.V2), VectorX4.Broadcast(map.V3));
        for (var i = 0; i < paddedCount; i += SubFractal.Lanes)
        {
            var (centre, halfSize) = (VectorX4.Load(ref rows, i, paddedCount), VectorX4.Load(ref rows, (3 * paddedCount) + i, paddedCount));
            var fromCentre = fromOrigin - ((centre.X * v1) + (centre.Y * v2) + (centre.Z * v3));
            queue.SetBounds(DistanceSquared(fromCentre, halfSize, v1, v2, v3), fromCentre.LengthSquared(), i);
        }
    }

    /// <summary>The squared distances to boxes around the images of boxes.</summary>
    /// <param name="fromCentre">From the images of their centres.</param>
    /// <param name="halfSize">Of the boxes.</param>
    /// <param name="v1">The map's first column.</param>
    /// <param name="v2">The second.</param>
    /// <param name="v3">The third.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector256<double> DistanceSquared(VectorX4 fromCentre, VectorX4 halfSize, VectorX4 v1, VectorX4 v2, VectorX4 v3)
    {
        var extent = (halfSize.X * v1.Absolute()) + (halfSize.Y * v2.Absolute()) + (halfSize.Z * v3.Absolute());
        return VectorX4.Max(fromCentre.Absolute() - extent, VectorX4.Zero).LengthSquared();
    }
}
