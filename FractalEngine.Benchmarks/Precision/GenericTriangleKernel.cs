using System.Numerics;
using System.Runtime.CompilerServices;

namespace FractalEngine.Benchmarks.Precision;

/// <summary>
/// Computes the squared distance of <see cref="Core.Geometry.Triangles.TriangleKernel"/> by the same operations in the same order, in
/// float or in double, to compare the two. The engine itself has no floats before the GPU.
/// </summary>
/// <typeparam name="T">Type of the numbers.</typeparam>
internal static class GenericTriangleKernel<T>
    where T : struct, IFloatingPointIeee754<T>
{
    private static readonly T ThinSineSquared = T.CreateChecked(1e-6);

    /// <summary>A vector of three numbers.</summary>
    internal readonly record struct Triple(T X, T Y, T Z)
    {
        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public static Triple operator +(Triple v, Triple w) => new(v.X + w.X, v.Y + w.Y, v.Z + w.Z);

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public static Triple operator -(Triple v, Triple w) => new(v.X - w.X, v.Y - w.Y, v.Z - w.Z);

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public static Triple operator *(T factor, Triple v) => new(factor * v.X, factor * v.Y, factor * v.Z);

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public static T Dot(Triple v, Triple w) => (v.X * w.X) + (v.Y * w.Y) + (v.Z * w.Z);

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public static Triple Cross(Triple v, Triple w) =>
            new((v.Y * w.Z) - (v.Z * w.Y), (v.Z * w.X) - (v.X * w.Z), (v.X * w.Y) - (v.Y * w.X));

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public T LengthSquared() => Dot(this, this);
    }

    /// <summary>Computes the squared distance of a position from the triangle abc.</summary>
    public static T DistanceSquared(Triple position, Triple a, Triple b, Triple c)
    {
        var closest = Min(Min(DistanceSquaredToEdge(position, a, b), DistanceSquaredToEdge(position, b, c)),
            DistanceSquaredToEdge(position, c, a));
        var (ab, ac, ap) = (b - a, c - a, position - a);
        var normal = Triple.Cross(ab, ac);
        var normalSquared = normal.LengthSquared();
        var weightC = Triple.Dot(Triple.Cross(ab, ap), normal) / normalSquared;
        var weightB = Triple.Dot(Triple.Cross(ap, ac), normal) / normalSquared;
        var isThin = !(normalSquared > ThinSineSquared * (ab.LengthSquared() * ac.LengthSquared()));
        for (var step = 0; isThin && step < 3; step++)
        {
            var residual = position - (a + (weightB * ab) + (weightC * ac));
            weightC += Triple.Dot(Triple.Cross(ab, residual), normal) / normalSquared;
            weightB += Triple.Dot(Triple.Cross(residual, ac), normal) / normalSquared;
        }

        if (!(weightB >= T.Zero && weightC >= T.Zero && T.One - weightB - weightC >= T.Zero))
        {
            return closest;
        }

        var height = Triple.Dot(ap, normal);
        return Min(closest, isThin
            ? (position - (a + (weightB * ab) + (weightC * ac))).LengthSquared()
            : height * height / normalSquared);
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private static T Min(T x, T y) => y < x ? y : x;

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private static T DistanceSquaredToEdge(Triple position, Triple start, Triple end)
    {
        var (along, from) = (end - start, position - start);
        var lengthSquared = along.LengthSquared();
        var t = lengthSquared > T.Zero ? Triple.Dot(from, along) / lengthSquared : T.Zero;
        t = t <= T.Zero ? T.Zero : t >= T.One ? T.One : t;
        return (position - (t == T.One ? end : start + (t * along))).LengthSquared();
    }
}
