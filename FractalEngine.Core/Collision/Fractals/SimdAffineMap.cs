using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Collision.Fractals;

/// <summary>An <see cref="AffineMap"/> whose columns lie in vectors of the processor: x, y, z, 0.</summary>
internal readonly struct SimdAffineMap
{
    private readonly Vector256<double> _translation;

    public SimdAffineMap(AffineMap map) =>
        (V1, V2, V3, _translation) = (ToVector256(map.Linear.V1), ToVector256(map.Linear.V2), ToVector256(map.Linear.V3),
        ToVector256(map.Translation));

    private SimdAffineMap(Vector256<double> v1, Vector256<double> v2, Vector256<double> v3, Vector256<double> translation) =>
        (V1, V2, V3, _translation) = (v1, v2, v3, translation);

    /// <summary>First column of the matrix.</summary>
    public Vector256<double> V1 { get; }

    /// <summary>Second column.</summary>
    public Vector256<double> V2 { get; }

    /// <summary>Third column.</summary>
    public Vector256<double> V3 { get; }

    /// <summary>The image of the origin.</summary>
    public Vector256<double> Translation => _translation;

    /// <summary>A vector: x, y, z, 0.</summary>
    public static Vector256<double> ToVector256(Vector v) => Vector256.Create(v.X, v.Y, v.Z, 0);

    /// <summary>Back from lanes.</summary>
    public static Vector ToVector(Vector256<double> lanes) => new(lanes[0], lanes[1], lanes[2]);

    /// <summary>First the second map, then the first.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static SimdAffineMap Compose(in SimdAffineMap map1, in SimdAffineMap map2) =>
        new(map1.ApplyLinear(map2.V1), map1.ApplyLinear(map2.V2), map1.ApplyLinear(map2.V3), map1.Apply(map2._translation));

    /// <summary>The image of a point.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public Vector256<double> Apply(Vector256<double> point) => ApplyLinear(point) + _translation;

    /// <summary>The product of the transposed matrix with a vector.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public Vector256<double> MultiplyTransposed(Vector256<double> direction) =>
        Vector256.Create(Vector256.Dot(V1, direction), Vector256.Dot(V2, direction), Vector256.Dot(V3, direction), 0);

    /// <summary>Half the size of a box around the image of a box.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public Vector256<double> TransformHalfSize(Vector256<double> halfSize) => (Vector256.Create(halfSize[0]) * Vector256.Abs(V1))
        + (Vector256.Create(halfSize[1]) * Vector256.Abs(V2)) + (Vector256.Create(halfSize[2]) * Vector256.Abs(V3));

    /// <summary>The square of a factor by which the map lengthens at most: the sum of the squares of its entries.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public double FrobeniusNormSquared() => Vector256.Sum((V1 * V1) + (V2 * V2) + (V3 * V3));

    /// <summary>The same map.</summary>
    public AffineMap ToAffineMap() => new(new(ToVector(V1), ToVector(V2), ToVector(V3)), ToVector(_translation));

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private Vector256<double> ApplyLinear(Vector256<double> v) =>
        (Vector256.Create(v[0]) * V1) + (Vector256.Create(v[1]) * V2) + (Vector256.Create(v[2]) * V3);
}
