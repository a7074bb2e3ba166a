using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Bvh;

/// <summary>
/// Triangles in single precision, each in a frame of its own. It begins at the foot of the altitude on the longest edge. Its x axis runs
/// along that edge, and its y axis up the altitude. So the triangle consists of two right triangles, and the sign of x tells which of them
/// is closer.
/// </summary>
/// <remarks>
/// No formula divides by an area, so thin triangles and triangles without area lose no precision. A leaf of n triangles consists of
/// <see cref="Rows"/> rows of n floats. Eight lanes are read whatever n is: those beyond the row are to be ignored.
/// </remarks>
internal static class TriangleFrames
{
    /// <summary>
    /// Floats of a triangle: foot x, y and z, x axis x, y and z, y axis x, y and z, altitude, base on the left and base on the right.
    /// </summary>
    public const int Rows = 12;

    // Squared lengths below this count as this, so that nothing is divided by zero. Lengths are relative to the mesh.
    private const float MinLengthSquared = 1e-30f;

    // Triangles below this size count as points, since the square of a smaller length loses places.
    private const double MinLength = 1e-100;

    // Altitudes below this part of the longest edge count as zero. Rounding to single precision hides them.
    private const double MinRelativeAltitude = 1.0 / (1L << 36);

    /// <summary>Computes the squared distances of a position from the triangles of a leaf.</summary>
    /// <param name="leaf">The first float of the leaf; eight floats can be read from the beginning of the last row.</param>
    /// <param name="count">Number of triangles, from 1 to 8.</param>
    /// <param name="px">The position's x in all lanes.</param>
    /// <param name="py">The position's y in all lanes.</param>
    /// <param name="pz">The position's z in all lanes.</param>
    /// <returns>A squared distance for each triangle; lanes from <paramref name="count"/> on are meaningless.</returns>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static Vector256<float> DistancesSquared(
        ref float leaf, nint count, Vector256<float> px, Vector256<float> py, Vector256<float> pz)
    {
        var fromFootX = px - Row(ref leaf, 0, count);
        var fromFootY = py - Row(ref leaf, 1, count);
        var fromFootZ = pz - Row(ref leaf, 2, count);
        var axisXX = Row(ref leaf, 3, count);
        var axisXY = Row(ref leaf, 4, count);
        var axisXZ = Row(ref leaf, 5, count);
        var axisYX = Row(ref leaf, 6, count);
        var axisYY = Row(ref leaf, 7, count);
        var axisYZ = Row(ref leaf, 8, count);
        var x = (fromFootX * axisXX) + (fromFootY * axisXY) + (fromFootZ * axisXZ);
        var y = (fromFootX * axisYX) + (fromFootY * axisYY) + (fromFootZ * axisYZ);
        // What remains without the components in the plane is perpendicular to it.
        var heightX = fromFootX - (x * axisXX) - (y * axisYX);
        var heightY = fromFootY - (x * axisXY) - (y * axisYY);
        var heightZ = fromFootZ - (x * axisXZ) - (y * axisYZ);
        var zero = Vector256<float>.Zero;
        var altitude = Row(ref leaf, 9, count);
        var width = Vector256.ConditionalSelect(Vector256.LessThan(x, zero), Row(ref leaf, 10, count), Row(ref leaf, 11, count));
        var above = Vector256.MaxNative(y, zero);
        var below = y - above;
        var beyond = Vector256.Abs(x) - width;
        var lengthSquared = Vector256.MaxNative((width * width) + (altitude * altitude), Vector256.Create(MinLengthSquared));
        var t = ((above * altitude) - (beyond * width)) / lengthSquared;
        t = Vector256.MinNative(Vector256.MaxNative(t, zero), Vector256<float>.One);
        var fromEdgeX = beyond + (t * width);
        var fromEdgeY = above - (t * altitude);
        var outsideMask = Vector256.GreaterThanOrEqual((beyond * altitude) + (above * width), zero);
        var inPlaneSquared = ((fromEdgeX * fromEdgeX) + (fromEdgeY * fromEdgeY)) & outsideMask;
        return (heightX * heightX) + (heightY * heightY) + (heightZ * heightZ) + (below * below) + inPlaneSquared;
    }

    /// <summary>Computes the frames of the triangles of a leaf.</summary>
    /// <param name="mesh">The mesh of the triangles.</param>
    /// <param name="origin">Origin of the frames' coordinates.</param>
    /// <param name="scale">Factor by which coordinates relative to the origin are multiplied, a power of two.</param>
    /// <param name="faces">Face indices of the triangles.</param>
    /// <param name="rows">Receives the rows of the leaf.</param>
    /// <returns>The length of the longest edge.</returns>
    [MethodImpl(MethodImplOptions.AggressiveOptimization)]
    public static double Write(Mesh mesh, Vector origin, double scale, ReadOnlySpan<int> faces, Span<float> rows)
    {
        var simdOrigin = SimdAffineMap.ToVector256(origin);
        var simdScale = Vector256.Create(scale);
        var longestEdge = 0.0;
        for (var i = 0; i < faces.Length; i++)
        {
            var (a, b, c) = mesh.Face(faces[i]);
            var length = Write(
                (SimdAffineMap.ToVector256(a) - simdOrigin) * simdScale, (SimdAffineMap.ToVector256(b) - simdOrigin) * simdScale,
                (SimdAffineMap.ToVector256(c) - simdOrigin) * simdScale, rows[i..], faces.Length);
            longestEdge = Math.Max(longestEdge, length);
        }

        return longestEdge;
    }

    // A mesh is built once, often before the tiers of the compiler have warmed up.
    [MethodImpl(MethodImplOptions.AggressiveOptimization)]
    private static double Write(Vector256<double> a, Vector256<double> b, Vector256<double> c, Span<float> rows, int stride)
    {
        // The longest edge runs from b to c.
        var ab = LengthSquared(b - a);
        var bc = LengthSquared(c - b);
        var ca = LengthSquared(a - c);
        if (ab > bc && ab >= ca)
        {
            (a, b, c) = (c, a, b);
        }
        else if (ca > bc)
        {
            (a, b, c) = (b, c, a);
        }

        var length = Math.Sqrt(LengthSquared(c - b));
        var axisX = (c - b) / Vector256.Create(length);
        // A NaN, of a length of zero, stays one.
        var left = Math.Min(Math.Max(Vector256.Dot(a - b, axisX), 0), length);
        var alongEdge = Vector256.Create(left) * axisX;
        // Not from the foot, which is rounded to the last place of a coordinate.
        var toApex = a - b - alongEdge;
        toApex -= Vector256.Create(Vector256.Dot(toApex, axisX)) * axisX;
        var altitude = Math.Sqrt(LengthSquared(toApex));
        if (!(length > MinLength) || !(altitude > MinRelativeAltitude * length))
        {
            return WriteThin(SimdAffineMap.ToVector(a), SimdAffineMap.ToVector(b), SimdAffineMap.ToVector(c), rows, stride);
        }

        var foot = FloatRounding.ToNearest(b + alongEdge);
        var floatAxisX = FloatRounding.ToNearest(axisX);
        var floatAxisY = FloatRounding.ToNearest(toApex / Vector256.Create(altitude));
        for (var axis = 0; axis < 3; axis++)
        {
            rows[axis * stride] = foot[axis];
            rows[(3 + axis) * stride] = floatAxisX[axis];
            rows[(6 + axis) * stride] = floatAxisY[axis];
        }

        rows[9 * stride] = (float)altitude;
        rows[10 * stride] = (float)left;
        rows[11 * stride] = (float)(length - left);
        return length;
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private static double LengthSquared(Vector256<double> v) => Vector256.Dot(v, v);

    /// <summary>Writes the frame of a triangle without altitude: its longest edge is left of it, or one point.</summary>
    private static double WriteThin(Vector a, Vector b, Vector c, Span<float> rows, int stride)
    {
        var length = (c - b).Length();
        length = length > MinLength ? length : 0;
        var axisX = length > 0 ? (c - b) / length : Vector.I;
        var left = Math.Clamp(Vector.Dot(a - b, axisX), 0, length);
        var foot = b + (left * axisX);
        var (x, y, z) = axisX.Absolute();
        var axisY = Vector.Cross(axisX, x <= y && x <= z ? Vector.I : y <= z ? Vector.J : Vector.K).UnitVector();
        ReadOnlySpan<double> values =
            [foot.X, foot.Y, foot.Z, axisX.X, axisX.Y, axisX.Z, axisY.X, axisY.Y, axisY.Z, 0, left, length - left];
        for (var row = 0; row < Rows; row++)
        {
            rows[row * stride] = (float)values[row];
        }

        return length;
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private static Vector256<float> Row(ref float leaf, nint row, nint count) =>
        Vector256.LoadUnsafe(ref Unsafe.Add(ref leaf, row * count));
}
