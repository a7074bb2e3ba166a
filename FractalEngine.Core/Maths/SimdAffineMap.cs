using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;

namespace FractalEngine.Core.Maths;

/// <summary>An <see cref="AffineMap"/> for kernels: each column is a SIMD vector x, y, z, 0.</summary>
internal readonly struct SimdAffineMap(Vector256<double> v1, Vector256<double> v2, Vector256<double> v3, Vector256<double> translation)
{
    /// <summary>Converts a map without rounding.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public SimdAffineMap(in AffineMap map)
        : this(ToVector256(map.Linear.V1), ToVector256(map.Linear.V2), ToVector256(map.Linear.V3), ToVector256(map.Translation))
    {
    }

    /// <summary>The map that changes nothing.</summary>
    public static readonly SimdAffineMap Identity = new(AffineMap.Identity);

    /// <summary>First column of the linear part.</summary>
    public Vector256<double> V1 { get; } = v1;

    /// <summary>Second column of the linear part.</summary>
    public Vector256<double> V2 { get; } = v2;

    /// <summary>Third column of the linear part.</summary>
    public Vector256<double> V3 { get; } = v3;

    /// <summary>The image of the origin.</summary>
    public Vector256<double> Translation { get; } = translation;

    /// <summary>Converts a vector to x, y, z, 0.</summary>
    public static Vector256<double> ToVector256(Vector v) => Vector256.Create(v.X, v.Y, v.Z, 0);

    /// <summary>Converts x, y, z and any fourth lane to a vector.</summary>
    public static Vector ToVector(Vector256<double> v) => new(v[0], v[1], v[2]);

    /// <summary>Composes two maps: <paramref name="map2"/> is applied first, then <paramref name="map1"/>.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static SimdAffineMap Compose(in SimdAffineMap map1, in SimdAffineMap map2) =>
        new(map1.ApplyLinear(map2.V1), map1.ApplyLinear(map2.V2), map1.ApplyLinear(map2.V3), map1.Apply(map2.Translation));

    /// <inheritdoc cref="Compose(in SimdAffineMap, in SimdAffineMap)"/>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static SimdAffineMap Compose(in SimdAffineMap map1, in AffineMap map2) => new(
        map1.ApplyLinear(map2.Linear.V1), map1.ApplyLinear(map2.Linear.V2), map1.ApplyLinear(map2.Linear.V3),
        map1.ApplyLinear(map2.Translation) + map1.Translation);

    /// <summary>Maps a point x, y, z, 0.</summary>
    public Vector256<double> Apply(Vector256<double> point) => ApplyLinear(point) + Translation;

    /// <summary>Maps a point as the <see cref="AffineMap"/> does.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public Vector Apply(Vector point) => ToVector(ApplyLinear(point) + Translation);

    /// <summary>Multiplies the transposed linear part by a vector.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public Vector256<double> MultiplyTransposed(Vector256<double> direction) =>
        Vector256.Create(Vector256.Dot(V1, direction), Vector256.Dot(V2, direction), Vector256.Dot(V3, direction), 0);

    /// <summary>Computes half the size of a box around the image of a box.</summary>
    /// <param name="halfSize">Half the size of the box that is mapped.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public Vector256<double> TransformHalfSize(Vector256<double> halfSize) => (Vector256.Create(halfSize[0]) * Vector256.Abs(V1))
        + (Vector256.Create(halfSize[1]) * Vector256.Abs(V2)) + (Vector256.Create(halfSize[2]) * Vector256.Abs(V3));

    /// <summary>Computes the squared Frobenius norm of the linear part, an upper bound of its squared operator norm.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public double FrobeniusNormSquared() => Vector256.Sum((V1 * V1) + (V2 * V2) + (V3 * V3));

    /// <summary>Converts the map back without rounding.</summary>
    public AffineMap ToAffineMap() => new(new(ToVector(V1), ToVector(V2), ToVector(V3)), ToVector(Translation));

    /// <summary>Maps a direction x, y, z, 0.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public Vector256<double> ApplyLinear(Vector256<double> v) =>
        (Vector256.Create(v[0]) * V1) + (Vector256.Create(v[1]) * V2) + (Vector256.Create(v[2]) * V3);

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private Vector256<double> ApplyLinear(Vector v) =>
        (Vector256.Create(v.X) * V1) + (Vector256.Create(v.Y) * V2) + (Vector256.Create(v.Z) * V3);
}
