using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Collision;

/// <summary>
/// <see cref="FaceKernel"/> on four faces at once, squared distances only. It does the reference's operations in the reference's
/// order, so the results are the same to the last bit; thin faces, which the reference looks at twice, it leaves to the reference.
/// </summary>
/// <remarks>The struct keeps what does not depend on a position, for faces that are asked very often.</remarks>
internal readonly struct FaceQuartet
{
    private readonly VectorQuartet _a;
    private readonly VectorQuartet _b;
    private readonly VectorQuartet _c;
    private readonly Shape _shape;

    /// <summary>Four faces by their corners.</summary>
    public FaceQuartet(VectorQuartet a, VectorQuartet b, VectorQuartet c) => (_a, _b, _c, _shape) = (a, b, c, Shape.Of(a, b, c));

    /// <summary>The squared distances of a position from four faces.</summary>
    /// <param name="faces">The four.</param>
    /// <param name="position">In their frame.</param>
    /// <param name="nearest">The squared distance of the nearest so far: where the planes of all four are farther, the result is infinite.</param>
    [MethodImpl(MethodImplOptions.NoInlining)]
    public static Vector256<double> SquaredDistances(ref readonly FaceQuartet faces, ref readonly Vector position, double nearest) =>
        Compute(in position, faces._a, faces._b, faces._c, faces._shape, nearest);

    /// <summary>The same for four faces of a mesh.</summary>
    /// <param name="leaf">Numbers of their corners.</param>
    /// <param name="positions">Of the mesh's vertices, [vertices × 3].</param>
    /// <param name="position">In the mesh's frame.</param>
    [MethodImpl(MethodImplOptions.NoInlining)]
    public static Vector256<double> SquaredDistances(ref readonly HierarchyLeaf leaf, ReadOnlySpan<double> positions, ref readonly Vector position)
    {
        var a = VectorQuartet.Gather(positions, leaf.A);
        var b = VectorQuartet.Gather(positions, leaf.B);
        var c = VectorQuartet.Gather(positions, leaf.C);
        return Compute(in position, a, b, c, Shape.Of(a, b, c), null);
    }

    /// <summary>The same for the images of four faces of a mesh.</summary>
    /// <param name="leaf">Numbers of their corners.</param>
    /// <param name="positions">Of the mesh's vertices, [vertices × 3].</param>
    /// <param name="position">In the frame of the images.</param>
    /// <param name="map">From the mesh's frame.</param>
    [MethodImpl(MethodImplOptions.NoInlining)]
    public static Vector256<double> SquaredDistances(
        ref readonly HierarchyLeaf leaf, ReadOnlySpan<double> positions, ref readonly Vector position, ref readonly AffineMap map)
    {
        var a = VectorQuartet.Gather(positions, leaf.A).Transform(in map);
        var b = VectorQuartet.Gather(positions, leaf.B).Transform(in map);
        var c = VectorQuartet.Gather(positions, leaf.C).Transform(in map);
        return Compute(in position, a, b, c, Shape.Of(a, b, c), null);
    }

    /// <summary>Normals, not of length 1, squares of lengths, and a mask of the faces that are thin.</summary>
    private readonly record struct Shape(
        VectorQuartet Normal, Vector256<double> NormalSquared, Vector256<double> AB, Vector256<double> BC, Vector256<double> CA)
    {
        public Vector256<double> Thin
        {
            [MethodImpl(MethodImplOptions.AggressiveInlining)]
            get => ~Vector256.GreaterThan(NormalSquared, Vector256.Create(FaceKernel.ThinSineSquared) * (AB * CA));
        }

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public static Shape Of(VectorQuartet a, VectorQuartet b, VectorQuartet c)
        {
            var ab = b - a;
            var normal = VectorQuartet.Cross(ab, c - a);
            return new(normal, normal.LengthSquared(), ab.LengthSquared(), (c - b).LengthSquared(), (a - c).LengthSquared());
        }
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private static Vector256<double> Compute(ref readonly Vector position, VectorQuartet a, VectorQuartet b, VectorQuartet c, Shape shape, double? nearestSoFar)
    {
        var p = VectorQuartet.All(position);
        var (normal, normalSquared) = (shape.Normal, shape.NormalSquared);
        var ab = b - a;
        var ac = c - a;
        var ap = p - a;
        var height = VectorQuartet.Dot(ap, normal);
        var thin = shape.Thin;
        // A fifth less time where the normals are at hand, nothing where they must be computed first.
        if (nearestSoFar is { } limit && AreFarther(height * height / normalSquared, limit, ap) && thin.AsInt64() == Vector256<long>.Zero)
        {
            return Vector256.Create(double.PositiveInfinity);
        }

        var weightC = VectorQuartet.Dot(VectorQuartet.Cross(ab, ap), normal) / normalSquared;
        var weightB = VectorQuartet.Dot(VectorQuartet.Cross(ap, ac), normal) / normalSquared;
        var weightA = Vector256<double>.One - weightB - weightC;
        var inside = Vector256.GreaterThanOrEqual(
            Vector256.MinNative(Vector256.MinNative(weightB, weightC), weightA), Vector256<double>.Zero);
        var nearest = Vector256.ConditionalSelect(inside, height * height / normalSquared, Vector256.Create(double.PositiveInfinity));
        nearest = Vector256.MinNative(ToEdge(p, ap, a, b, ab, shape.AB), nearest);
        nearest = Vector256.MinNative(ToEdge(p, p - b, b, c, c - b, shape.BC), nearest);
        nearest = Vector256.MinNative(ToEdge(p, p - c, c, a, a - c, shape.CA), nearest);
        return thin.AsInt64() == Vector256<long>.Zero ? nearest : WithThinOnes(position, nearest, thin, a, b, c);
    }

    /// <summary>True when all four planes are farther than the limit, and by more than rounding.</summary>
    /// <remarks>
    /// The height above the plane of a face that is not thin is wrong by less than δ = 1e-12·|ap|, and (d + δ)² ≤ (1 + s)·d² + (1 + 1/s)·δ²
    /// for s = 1e-6.
    /// </remarks>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private static bool AreFarther(Vector256<double> heightSquared, double limit, VectorQuartet ap) =>
        Vector256.GreaterThanAll(heightSquared, Vector256.Create(1.000001 * limit) + (Vector256.Create(1e-17) * ap.LengthSquared()));

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private static Vector256<double> ToEdge(
        VectorQuartet position, VectorQuartet from, VectorQuartet start, VectorQuartet end, VectorQuartet along, Vector256<double> lengthSquared)
    {
        var zero = Vector256<double>.Zero;
        var t = VectorQuartet.Dot(from, along) / lengthSquared & Vector256.GreaterThan(lengthSquared, zero);
        t = Vector256.MinNative(Vector256.MaxNative(t, zero), Vector256<double>.One);
        var point = VectorQuartet.Select(Vector256.Equals(t, Vector256<double>.One), end, start + (t * along));
        return (position - point).LengthSquared();
    }

    [MethodImpl(MethodImplOptions.NoInlining)]
    private static Vector256<double> WithThinOnes(
        Vector position, Vector256<double> nearest, Vector256<double> thin, VectorQuartet a, VectorQuartet b, VectorQuartet c)
    {
        for (var i = 0; i < 4; i++)
        {
            if (thin.AsInt64()[i] != 0)
            {
                nearest = nearest.WithElement(i, FaceKernel.ClosestPoint(position, a[i], b[i], c[i]).DistanceSquared);
            }
        }

        return nearest;
    }
}
