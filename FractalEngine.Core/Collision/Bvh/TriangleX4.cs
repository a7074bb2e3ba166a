using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Collision.Bvh;

/// <summary>
/// <see cref="TriangleKernel"/> on four faces at once, squared distances only. It does the reference's operations in the reference's
/// order, so the results are the same to the last bit; thin faces, which the reference looks at twice, it leaves to the reference.
/// </summary>
/// <remarks>The struct keeps what does not depend on a position, for faces that are asked very often.</remarks>
internal readonly struct TriangleX4
{
    private readonly VectorX4 _a;
    private readonly VectorX4 _b;
    private readonly VectorX4 _c;
    private readonly PrecomputedTerms _terms;

    /// <summary>Four faces by their corners.</summary>
    public TriangleX4(VectorX4 a, VectorX4 b, VectorX4 c) => (_a, _b, _c, _terms) = (a, b, c, PrecomputedTerms.Of(a, b, c));

    /// <summary>The squared distances of a position from four faces.</summary>
    /// <param name="triangles">The four.</param>
    /// <param name="position">In their frame.</param>
    /// <param name="closestDistanceSquared">
    /// The squared distance of the nearest so far: where the planes of all four are farther, the result is infinite.
    /// </param>
    [MethodImpl(MethodImplOptions.NoInlining)]
    public static Vector256<double> DistancesSquared(ref readonly TriangleX4 triangles, ref readonly Vector position,
    double closestDistanceSquared) =>
        ComputeDistancesSquared(in position, triangles._a, triangles._b, triangles._c, triangles._terms, closestDistanceSquared);

    /// <summary>The same for four faces of a mesh.</summary>
    /// <param name="leaf">Numbers of their corners.</param>
    /// <param name="positions">Of the mesh's vertices, [vertices × 3].</param>
    /// <param name="position">In the mesh's frame.</param>
    [MethodImpl(MethodImplOptions.NoInlining)]
    public static Vector256<double> DistancesSquared(ref readonly BvhLeaf leaf, ReadOnlySpan<double> positions,
    ref readonly Vector position)
    {
        var a = VectorX4.Gather(positions, leaf.IndicesA);
        var b = VectorX4.Gather(positions, leaf.IndicesB);
        var c = VectorX4.Gather(positions, leaf.IndicesC);
        return ComputeDistancesSquared(in position, a, b, c, PrecomputedTerms.Of(a, b, c), null);
    }

    /// <summary>The same for the images of four faces of a mesh.</summary>
    /// <param name="leaf">Numbers of their corners.</param>
    /// <param name="positions">Of the mesh's vertices, [vertices × 3].</param>
    /// <param name="position">In the frame of the images.</param>
    /// <param name="map">From the mesh's frame.</param>
    [MethodImpl(MethodImplOptions.NoInlining)]
    public static Vector256<double> DistancesSquared(
        ref readonly BvhLeaf leaf, ReadOnlySpan<double> positions, ref readonly Vector position, ref readonly AffineMap map)
    {
        var a = VectorX4.Gather(positions, leaf.IndicesA).Transform(in map);
        var b = VectorX4.Gather(positions, leaf.IndicesB).Transform(in map);
        var c = VectorX4.Gather(positions, leaf.IndicesC).Transform(in map);
        return ComputeDistancesSquared(in position, a, b, c, PrecomputedTerms.Of(a, b, c), null);
    }

    /// <summary>Normals, not of length 1, squares of lengths, and a mask of the faces that are thin.</summary>
    private readonly record struct PrecomputedTerms(
        VectorX4 Normal, Vector256<double> NormalSquared, Vector256<double> LengthSquaredAB, Vector256<double> LengthSquaredBC,
        Vector256<double> LengthSquaredCA)
    {
        public Vector256<double> ThinMask
        {
            [MethodImpl(MethodImplOptions.AggressiveInlining)]
            get => ~Vector256.GreaterThan(NormalSquared, Vector256.Create(TriangleKernel.ThinTriangleSineSquared)
                * (LengthSquaredAB * LengthSquaredCA));
        }

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public static PrecomputedTerms Of(VectorX4 a, VectorX4 b, VectorX4 c)
        {
            var ab = b - a;
            var normal = VectorX4.Cross(ab, c - a);
            return new(normal, normal.LengthSquared(), ab.LengthSquared(), (c - b).LengthSquared(), (a - c).LengthSquared());
        }
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private static Vector256<double> ComputeDistancesSquared(ref readonly Vector position, VectorX4 a, VectorX4 b, VectorX4 c,
    PrecomputedTerms terms, double? closestDistanceSquared)
    {
        var p = VectorX4.Broadcast(position);
        var (normal, normalSquared) = (terms.Normal, terms.NormalSquared);
        var ab = b - a;
        var ac = c - a;
        var ap = p - a;
        var height = VectorX4.Dot(ap, normal);
        var thinMask = terms.ThinMask;
        // A fifth less time where the normals are at hand, nothing where they must be computed first.
        if (closestDistanceSquared is { } cutoffSquared && ArePlanesFarther(height * height / normalSquared, cutoffSquared, ap)
            && thinMask.AsInt64() == Vector256<long>.Zero)
        {
            return Vector256.Create(double.PositiveInfinity);
        }

        var weightC = VectorX4.Dot(VectorX4.Cross(ab, ap), normal) / normalSquared;
        var weightB = VectorX4.Dot(VectorX4.Cross(ap, ac), normal) / normalSquared;
        var weightA = Vector256<double>.One - weightB - weightC;
        var insideMask = Vector256.GreaterThanOrEqual(
            Vector256.MinNative(Vector256.MinNative(weightB, weightC), weightA), Vector256<double>.Zero);
        var distancesSquared = Vector256.ConditionalSelect(insideMask, height * height / normalSquared,
            Vector256.Create(double.PositiveInfinity));
        distancesSquared = Vector256.MinNative(EdgeDistancesSquared(p, ap, a, b, ab, terms.LengthSquaredAB), distancesSquared);
        distancesSquared = Vector256.MinNative(EdgeDistancesSquared(p, p - b, b, c, c - b, terms.LengthSquaredBC), distancesSquared);
        distancesSquared = Vector256.MinNative(EdgeDistancesSquared(p, p - c, c, a, a - c, terms.LengthSquaredCA), distancesSquared);
        return thinMask.AsInt64() == Vector256<long>.Zero
            ? distancesSquared
            : RecomputeThinTriangles(position, distancesSquared, thinMask, a, b, c);
    }

    /// <summary>True when all four planes are farther than the limit, and by more than rounding.</summary>
    /// <remarks>
    /// The height above the plane of a face that is not thin is wrong by less than δ = 1e-12·|ap|, and (d + δ)² ≤ (1 + s)·d² + (1 + 1/s)·δ²
    /// for s = 1e-6.
    /// </remarks>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private static bool ArePlanesFarther(Vector256<double> heightSquared, double cutoffSquared, VectorX4 ap) =>
        Vector256.GreaterThanAll(heightSquared, Vector256.Create(1.000001 * cutoffSquared)
            + (Vector256.Create(1e-17) * ap.LengthSquared()));

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private static Vector256<double> EdgeDistancesSquared(
        VectorX4 position, VectorX4 fromStart, VectorX4 start, VectorX4 end, VectorX4 edge, Vector256<double> lengthSquared)
    {
        var zero = Vector256<double>.Zero;
        var t = VectorX4.Dot(fromStart, edge) / lengthSquared & Vector256.GreaterThan(lengthSquared, zero);
        t = Vector256.MinNative(Vector256.MaxNative(t, zero), Vector256<double>.One);
        var point = VectorX4.ConditionalSelect(Vector256.Equals(t, Vector256<double>.One), end, start + (t * edge));
        return (position - point).LengthSquared();
    }

    [MethodImpl(MethodImplOptions.NoInlining)]
    private static Vector256<double> RecomputeThinTriangles(
        Vector position, Vector256<double> distancesSquared, Vector256<double> thinMask, VectorX4 a, VectorX4 b, VectorX4 c)
    {
        for (var i = 0; i < 4; i++)
        {
            if (thinMask.AsInt64()[i] != 0)
            {
                distancesSquared = distancesSquared.WithElement(i, TriangleKernel.ClosestPoint(position, a[i], b[i], c[i]).DistanceSquared);
            }
        }

        return distancesSquared;
    }
}
