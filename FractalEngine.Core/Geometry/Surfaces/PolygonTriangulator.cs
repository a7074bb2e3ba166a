using System.Runtime.CompilerServices;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Geometry.Surfaces;

/// <summary>
/// Cuts polygons in space into triangles by ear clipping (G. H. Meisters, "Polygons have ears", 1975). One instance is reused for many
/// polygons.
/// </summary>
/// <remarks>
/// Concave polygons come out right, where a fan would cover area outside them, and so do polygons that touch themselves, such as those with
/// holes behind bridges. A polygon of n corners gives exactly n − 2 triangles, wound as the polygon. Polygons that cross themselves have no
/// right result; they still give n − 2 triangles over their corners. Cost O(n·r) for r reflex corners, at worst O(n²).
/// </remarks>
public sealed class PolygonTriangulator
{
    // Products of two lengths within these powers of two neither overflow nor vanish.
    private const int MaxExponent = 400;

    private const int MaxScaleExponent = 1023;

    private readonly List<(double X, double Y)> _points = [];
    private readonly EarClipper _clipper = new();

    /// <summary>Cuts one polygon into triangles.</summary>
    /// <param name="corners">Positions of the corners in order, at least three.</param>
    /// <param name="triangles">Receives indices into <paramref name="corners"/>, three a triangle; it is not cleared.</param>
    public void Triangulate(ReadOnlySpan<Vector> corners, List<int> triangles)
    {
        ArgumentOutOfRangeException.ThrowIfLessThan(corners.Length, 3);
        if (corners.Length == 3)
        {
            triangles.AddRange([0, 1, 2]);
            return;
        }

        Project(corners);
        _clipper.Clip(_points, triangles);
    }

    /// <summary>
    /// Tells whether a quadrilateral is convex without straight corners. <see cref="Triangulate"/> then cuts it into the triangles
    /// (3, 0, 1) and (1, 2, 3), so that callers with many quadrilaterals need not call it.
    /// </summary>
    /// <returns>False also where sizes overflow.</returns>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static bool IsConvex(Vector a, Vector b, Vector c, Vector d)
    {
        var (toB, toC, toD) = (b - a, c - a, d - a);
        var normal = Vector.Cross(toB, toC) + Vector.Cross(toC, toD);
        if (!normal.IsFinite())
        {
            return false;
        }

        var size = normal.Absolute();
        var (p0, p1) = (Project(Vector.Zero, normal, size), Project(toB, normal, size));
        var (p2, p3) = (Project(toC, normal, size), Project(toD, normal, size));
        return EarClipper.TwiceSignedArea(p3, p0, p1) > 0 && EarClipper.TwiceSignedArea(p0, p1, p2) > 0
            && EarClipper.TwiceSignedArea(p1, p2, p3) > 0 && EarClipper.TwiceSignedArea(p2, p3, p0) > 0;
    }

    /// <summary>Projects the corners along the longest axis of the polygon's normal (by Newell's sums), keeping the winding.</summary>
    private void Project(ReadOnlySpan<Vector> corners)
    {
        var scale = ScaleFor(corners);
        var origin = scale * corners[0];
        var normal = Vector.Zero;
        for (var i = 0; i < corners.Length; i++)
        {
            normal += Vector.Cross((scale * corners[i]) - origin, (scale * corners[(i + 1) % corners.Length]) - origin);
        }

        var size = normal.Absolute();
        _points.Clear();
        foreach (var corner in corners)
        {
            _points.Add(Project((scale * corner) - origin, normal, size));
        }
    }

    /// <summary>Finds the power of two that brings a polygon, whose areas would overflow or vanish, to a size of one.</summary>
    /// <returns>1 for all others.</returns>
    private static double ScaleFor(ReadOnlySpan<Vector> corners)
    {
        var origin = corners[0];
        var size = 0.0;
        foreach (var corner in corners)
        {
            // Halves, since the difference of two large numbers may overflow.
            size = Math.Max(size, ((0.5 * corner) - (0.5 * origin)).MaxAbsComponent());
        }

        if (size == 0 || !double.IsFinite(size))
        {
            return 1;
        }

        var exponent = Math.ILogB(size) + 1;
        return Math.Abs(exponent) <= MaxExponent ? 1 : Math.ScaleB(1, Math.Min(-exponent, MaxScaleExponent));
    }

    /// <summary>Projects a vector along the longest axis of a normal, whose absolute components are its size.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private static (double X, double Y) Project(Vector v, Vector normal, Vector size) =>
        size.X >= size.Y && size.X >= size.Z ? (normal.X >= 0 ? (v.Y, v.Z) : (v.Z, v.Y))
        : size.Y >= size.Z ? (normal.Y >= 0 ? (v.Z, v.X) : (v.X, v.Z))
        : normal.Z >= 0 ? (v.X, v.Y) : (v.Y, v.X);
}
