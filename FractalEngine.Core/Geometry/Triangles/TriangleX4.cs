using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Geometry.Triangles;

/// <summary>
/// Computes the squared distances of <see cref="TriangleKernel"/> for four triangles at once. It does the reference's operations in the
/// reference's order, so the results are the same to the last bit. Thin triangles, which need iteration, are left to the reference.
/// </summary>
/// <remarks>The struct keeps what does not depend on a position, for triangles that are tested very often.</remarks>
/// <param name="a">The first vertex of each triangle.</param>
/// <param name="b">The second vertex of each triangle.</param>
/// <param name="c">The third vertex of each triangle.</param>
internal readonly struct TriangleX4(VectorX4 a, VectorX4 b, VectorX4 c)
{
    private readonly VectorX4 _a = a;
    private readonly VectorX4 _b = b;
    private readonly VectorX4 _c = c;
    private readonly PrecomputedTerms _terms = PrecomputedTerms.Create(a, b, c);

    /// <summary>Computes the squared distances of a position from four precomputed triangles.</summary>
    /// <param name="triangles">The four triangles.</param>
    /// <param name="position">In the triangles' frame.</param>
    /// <param name="closestDistanceSquared">
    /// Squared distance of the closest triangle so far. Where all four planes are farther, the result is infinite.
    /// </param>
    [MethodImpl(MethodImplOptions.NoInlining)]
    public static Vector256<double> DistancesSquared(
        ref readonly TriangleX4 triangles, ref readonly Vector position, double closestDistanceSquared) =>
        ComputeDistancesSquared(in position, triangles._a, triangles._b, triangles._c, triangles._terms, closestDistanceSquared);

    /// <summary>Computes the squared distances of a position from up to four triangles of a mesh.</summary>
    /// <param name="mesh">The mesh.</param>
    /// <param name="faces">One to four face indices; the last one fills the lanes that are left over.</param>
    /// <param name="position">In the mesh's frame.</param>
    [MethodImpl(MethodImplOptions.NoInlining)]
    public static Vector256<double> DistancesSquared(Mesh mesh, ReadOnlySpan<int> faces, ref readonly Vector position)
    {
        Gather(mesh, faces, out var a, out var b, out var c);
        return ComputeDistancesSquared(in position, a, b, c, PrecomputedTerms.Create(a, b, c), null);
    }

    /// <summary>Computes the squared distances of a position from the images of up to four triangles of a mesh.</summary>
    /// <param name="mesh">The mesh.</param>
    /// <param name="faces">One to four face indices; the last one fills the lanes that are left over.</param>
    /// <param name="position">In the frame of the images.</param>
    /// <param name="map">From the mesh's frame to that of the images.</param>
    [MethodImpl(MethodImplOptions.NoInlining)]
    public static Vector256<double> DistancesSquared(
        Mesh mesh, ReadOnlySpan<int> faces, ref readonly Vector position, ref readonly AffineMap map)
    {
        Gather(mesh, faces, out var a, out var b, out var c);
        a = a.Transform(in map);
        b = b.Transform(in map);
        c = c.Transform(in map);
        return ComputeDistancesSquared(in position, a, b, c, PrecomputedTerms.Create(a, b, c), null);
    }

    /// <summary>Computes the squared distances of a position from the images of four precomputed triangles.</summary>
    /// <param name="triangles">The four triangles.</param>
    /// <param name="position">In the frame of the images.</param>
    /// <param name="map">From the triangles' frame to that of the images.</param>
    [MethodImpl(MethodImplOptions.NoInlining)]
    public static Vector256<double> DistancesSquared(
        ref readonly TriangleX4 triangles, ref readonly Vector position, ref readonly AffineMap map)
    {
        var a = triangles._a.Transform(in map);
        var b = triangles._b.Transform(in map);
        var c = triangles._c.Transform(in map);
        return ComputeDistancesSquared(in position, a, b, c, PrecomputedTerms.Create(a, b, c), null);
    }

    /// <summary>Precomputes the terms of up to four triangles of a mesh.</summary>
    /// <param name="mesh">The mesh.</param>
    /// <param name="faces">One to four face indices; the last one fills the lanes that are left over.</param>
    public static TriangleX4 Create(Mesh mesh, ReadOnlySpan<int> faces)
    {
        Gather(mesh, faces, out var a, out var b, out var c);
        return new(a, b, c);
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private static void Gather(Mesh mesh, ReadOnlySpan<int> faces, out VectorX4 a, out VectorX4 b, out VectorX4 c)
    {
        var indices = mesh.VertexIndices.AsSpan();
        var last = faces.Length - 1;
        var face0 = indices.Slice(3 * faces[0], 3);
        var face1 = indices.Slice(3 * faces[Math.Min(1, last)], 3);
        var face2 = indices.Slice(3 * faces[Math.Min(2, last)], 3);
        var face3 = indices.Slice(3 * faces[last], 3);
        var positions = mesh.Positions.AsSpan();
        a = VectorX4.Gather(positions, Vector128.Create(face0[0], face1[0], face2[0], face3[0]));
        b = VectorX4.Gather(positions, Vector128.Create(face0[1], face1[1], face2[1], face3[1]));
        c = VectorX4.Gather(positions, Vector128.Create(face0[2], face1[2], face2[2], face3[2]));
    }

    /// <summary>The terms of four triangles that do not depend on a position: normals of any length, and squared lengths.</summary>
    private readonly record struct PrecomputedTerms(
        VectorX4 Normal, Vector256<double> NormalSquared, Vector256<double> LengthSquaredAB, Vector256<double> LengthSquaredBC,
        Vector256<double> LengthSquaredCA)
    {
        /// <summary>Has all bits set in the lanes of thin triangles.</summary>
        public Vector256<double> ThinMask
        {
            [MethodImpl(MethodImplOptions.AggressiveInlining)]
            get => ~Vector256.GreaterThan(NormalSquared, Vector256.Create(TriangleKernel.ThinTriangleSineSquared)
                * (LengthSquaredAB * LengthSquaredCA));
        }

        [MethodImpl(MethodImplOptions.AggressiveInlining)]
        public static PrecomputedTerms Create(VectorX4 a, VectorX4 b, VectorX4 c)
        {
            var ab = b - a;
            var normal = VectorX4.Cross(ab, c - a);
            return new(normal, normal.LengthSquared(), ab.LengthSquared(), (c - b).LengthSquared(), (a - c).LengthSquared());
        }
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private static Vector256<double> ComputeDistancesSquared(
        ref readonly Vector position, VectorX4 a, VectorX4 b, VectorX4 c, PrecomputedTerms terms, double? closestDistanceSquared)
    {
        var p = VectorX4.Broadcast(position);
        var normal = terms.Normal;
        var normalSquared = terms.NormalSquared;
        var ab = b - a;
        var ac = c - a;
        var ap = p - a;
        var height = VectorX4.Dot(ap, normal);
        var thinMask = terms.ThinMask;
        // Saves a fifth of the time where normals are precomputed, nothing where they must be computed first.
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
        var distancesSquared = Vector256.ConditionalSelect(
            insideMask, height * height / normalSquared, Vector256.Create(double.PositiveInfinity));
        distancesSquared = Vector256.MinNative(EdgeDistancesSquared(p, ap, a, b, ab, terms.LengthSquaredAB), distancesSquared);
        distancesSquared = Vector256.MinNative(EdgeDistancesSquared(p, p - b, b, c, c - b, terms.LengthSquaredBC), distancesSquared);
        distancesSquared = Vector256.MinNative(EdgeDistancesSquared(p, p - c, c, a, a - c, terms.LengthSquaredCA), distancesSquared);
        return thinMask.AsInt64() == Vector256<long>.Zero
            ? distancesSquared
            : RecomputeThinTriangles(position, distancesSquared, thinMask, a, b, c);
    }

    /// <summary>Tests whether all four planes are farther than the limit, by more than rounding.</summary>
    /// <remarks>
    /// The height above the plane of a triangle that is not thin is wrong by less than δ = 1e-12·|ap|. And (d + δ)² ≤ (1 + s)·d² +
    /// (1 + 1/s)·δ², here with s = 1e-6.
    /// </remarks>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private static bool ArePlanesFarther(Vector256<double> heightSquared, double cutoffSquared, VectorX4 ap) =>
        Vector256.GreaterThanAll(
            heightSquared, Vector256.Create(1.000001 * cutoffSquared) + (Vector256.Create(1e-17) * ap.LengthSquared()));

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
        for (var i = 0; i < VectorX4.Count; i++)
        {
            if (thinMask.AsInt64()[i] != 0)
            {
                distancesSquared = distancesSquared.WithElement(i, TriangleKernel.ClosestPoint(position, a[i], b[i], c[i]).DistanceSquared);
            }
        }

        return distancesSquared;
    }
}
