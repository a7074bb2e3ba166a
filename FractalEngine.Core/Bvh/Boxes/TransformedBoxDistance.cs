using System.Runtime.CompilerServices;
using System.Runtime.InteropServices;
using System.Runtime.Intrinsics;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Bvh.Boxes;

/// <summary>Computes squared distances to boxes around the images of boxes under any map, four at a time.</summary>
internal static class TransformedBoxDistance
{
    /// <summary>Queues children by the distances of boxes around their images.</summary>
    /// <param name="queue">The queue of the children.</param>
    /// <param name="childBounds">
    /// Boxes around the children, [6 × <paramref name="paddedCount"/>]: x, y, z of the centres, then of half the sizes.
    /// </param>
    /// <param name="paddedCount">Number of child boxes including padding, which is far from everything.</param>
    /// <param name="position">In the frame of the images: x, y, z, 0.</param>
    /// <param name="map">From the frame of the boxes to that of the images.</param>
    public static void FillQueue(
        in ChildQueue queue, double[] childBounds, int paddedCount, Vector256<double> position, in SimdAffineMap map)
    {
        ref var rows = ref MemoryMarshal.GetArrayDataReference(childBounds);
        var fromOrigin = VectorX4.Broadcast(position - map.Translation);
        var (v1, v2, v3) = (VectorX4.Broadcast(map.V1), VectorX4.Broadcast(map.V2), VectorX4.Broadcast(map.V3));
        for (var i = 0; i < paddedCount; i += VectorX4.Count)
        {
            var centre = VectorX4.Load(ref rows, i, paddedCount);
            var halfSize = VectorX4.Load(ref rows, (3 * paddedCount) + i, paddedCount);
            var fromCentre = fromOrigin - ((centre.X * v1) + (centre.Y * v2) + (centre.Z * v3));
            queue.SetBounds(DistanceSquared(fromCentre, halfSize, v1, v2, v3), fromCentre.LengthSquared(), i);
        }
    }

    /// <summary>Computes the squared distances of a position from boxes around the images of four boxes.</summary>
    /// <param name="fromCentre">From the images of the boxes' centres to the position.</param>
    /// <param name="halfSize">Half the sizes of the boxes.</param>
    /// <param name="v1">First column of the map's linear part.</param>
    /// <param name="v2">Second column of the map's linear part.</param>
    /// <param name="v3">Third column of the map's linear part.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector256<double> DistanceSquared(VectorX4 fromCentre, VectorX4 halfSize, VectorX4 v1, VectorX4 v2, VectorX4 v3)
    {
        var extent = (halfSize.X * v1.Absolute()) + (halfSize.Y * v2.Absolute()) + (halfSize.Z * v3.Absolute());
        return VectorX4.Max(fromCentre.Absolute() - extent, VectorX4.Zero).LengthSquared();
    }
}
