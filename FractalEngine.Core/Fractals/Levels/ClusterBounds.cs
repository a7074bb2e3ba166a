using System.Runtime.InteropServices;
using System.Runtime.Intrinsics;
using FractalEngine.Core.Bvh.Boxes;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Fractals.Levels;

/// <summary>
/// Bounds a sub-fractal by several boxes. Where one map throws far away, or enlarges what the others shrink, a single box or hull is
/// nearly empty, and at every level most of them would hold the position of a query.
/// </summary>
/// <param name="boxes">At least one box, none of them empty; that of most instances first.</param>
internal sealed class ClusterBounds(BoundingBox[] boxes)
{
    /// <summary>Maximum number of boxes.</summary>
    public const int MaxBoxes = 64;

    private readonly int _paddedCount = VectorX4.PaddedCount(boxes.Length);
    private readonly double[] _rows = VectorX4.CreateRows<BoundingBox>(boxes, 6, static box =>
    {
        var halfSize = (0.5 + RoundingErrors.Coordinate) * box.Size;
        return [box.Centre.X, box.Centre.Y, box.Centre.Z, halfSize.X, halfSize.Y, halfSize.Z];
    });

    /// <summary>The box of most instances.</summary>
    public BoundingBox Bulk { get; } = boxes[0];

    /// <summary>Number of bytes of the arrays.</summary>
    public long StorageBytes => (sizeof(double) * (long)_rows.Length) + 40;

    /// <summary>Computes the squared distance of a position from the closest box.</summary>
    /// <param name="position">In the frame of the sub-fractal: x, y, z, 0.</param>
    public double LowerBoundSquared(Vector256<double> position)
    {
        ref var rows = ref MemoryMarshal.GetArrayDataReference(_rows);
        var positionX4 = VectorX4.Broadcast(position);
        var lowest = Vector256.Create(double.PositiveInfinity);
        for (var i = 0; i < _paddedCount; i += VectorX4.Count)
        {
            var fromCentre = (positionX4 - VectorX4.Load(ref rows, i, _paddedCount)).Absolute();
            var outside = VectorX4.MaxNative(fromCentre - VectorX4.Load(ref rows, (3 * _paddedCount) + i, _paddedCount), VectorX4.Zero);
            lowest = Vector256.MinNative(lowest, outside.LengthSquared());
        }

        return -VectorX4.HorizontalMax(-lowest);
    }

    /// <summary>Computes the squared distance of a position from the closest box around the image of a box under a map.</summary>
    /// <param name="position">In the frame of the images: x, y, z, 0.</param>
    /// <param name="map">From the frame of the sub-fractal to that of the images.</param>
    public double LowerBoundSquared(Vector256<double> position, in SimdAffineMap map)
    {
        ref var rows = ref MemoryMarshal.GetArrayDataReference(_rows);
        var fromOrigin = VectorX4.Broadcast(position - map.Translation);
        var (v1, v2, v3) = (VectorX4.Broadcast(map.V1), VectorX4.Broadcast(map.V2), VectorX4.Broadcast(map.V3));
        var lowest = Vector256.Create(double.PositiveInfinity);
        for (var i = 0; i < _paddedCount; i += VectorX4.Count)
        {
            var centre = VectorX4.Load(ref rows, i, _paddedCount);
            var halfSize = VectorX4.Load(ref rows, (3 * _paddedCount) + i, _paddedCount);
            var fromCentre = fromOrigin - ((centre.X * v1) + (centre.Y * v2) + (centre.Z * v3));
            lowest = Vector256.MinNative(lowest, TransformedBoxDistance.DistanceSquared(fromCentre, halfSize, v1, v2, v3));
        }

        return -VectorX4.HorizontalMax(-lowest);
    }
}
