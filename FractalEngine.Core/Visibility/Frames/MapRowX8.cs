using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Visibility.Frames;

/// <summary>One row of an affine map in single precision, each entry in all lanes, for eight points at a time.</summary>
/// <param name="map">Map with the row's linear part.</param>
/// <param name="translation">Image of the point that coordinates are relative to, in place of the map's: x, y, z, 0.</param>
/// <param name="row">0 for x, 1 for y, 2 for z.</param>
[method: MethodImpl(MethodImplOptions.AggressiveInlining)]
internal readonly struct MapRowX8(in SimdAffineMap map, Vector256<double> translation, int row)
{
    private readonly Vector256<float> _x = Vector256.Create((float)map.V1[row]);
    private readonly Vector256<float> _y = Vector256.Create((float)map.V2[row]);
    private readonly Vector256<float> _z = Vector256.Create((float)map.V3[row]);
    private readonly Vector256<float> _translation = Vector256.Create((float)translation[row]);

    /// <summary>Computes the row's coordinate of the images of eight points.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public Vector256<float> Apply(Vector256<float> x, Vector256<float> y, Vector256<float> z) =>
        _translation + (_x * x) + (_y * y) + (_z * z);

    /// <summary>Computes half the extent of boxes around the images of eight boxes, along the row's axis.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public Vector256<float> TransformHalfSize(Vector256<float> halfX, Vector256<float> halfY, Vector256<float> halfZ) =>
        (Vector256.Abs(_x) * halfX) + (Vector256.Abs(_y) * halfY) + (Vector256.Abs(_z) * halfZ);
}
