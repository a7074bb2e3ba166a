using System.Runtime.CompilerServices;
using System.Runtime.InteropServices;
using System.Runtime.Intrinsics;

namespace FractalEngine.Core.Collision;

/// <summary>Distances to the images of boxes under any map, four at a time: to the boxes around the images.</summary>
internal static class ImageDistances
{
    /// <summary>Queues the copies of a sub-fractal by the distances of boxes around their images.</summary>
    /// <param name="queue">Of the copies.</param>
    /// <param name="state">The sub-fractal.</param>
    /// <param name="position">In the frame of the images: x, y, z, 0.</param>
    /// <param name="map">From the sub-fractal's frame to that of the images.</param>
    public static void Fill(CopyQueue queue, SubFractal state, Vector256<double> position, in AffineLanes map)
    {
        var padded = state.Padded;
        ref var row = ref MemoryMarshal.GetArrayDataReference(state.Bounds);
        var offset = VectorQuartet.All(position - map.Translation);
        var (v1, v2, v3) = (VectorQuartet.All(map.V1), VectorQuartet.All(map.V2), VectorQuartet.All(map.V3));
        for (var i = 0; i < padded; i += SubFractal.Lanes)
        {
            var (centre, halfSize) = (VectorQuartet.Load(ref row, i, padded), VectorQuartet.Load(ref row, (3 * padded) + i, padded));
            var away = offset - ((centre.X * v1) + (centre.Y * v2) + (centre.Z * v3));
            queue.Set(Beyond(away, halfSize, v1, v2, v3), away.LengthSquared(), i);
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
