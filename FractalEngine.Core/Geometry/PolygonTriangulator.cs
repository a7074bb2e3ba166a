using System.Runtime.CompilerServices;
using System.Runtime.InteropServices;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Geometry;

/// <summary>
/// Cuts polygons in space into triangles by ear clipping (G. H. Meisters, "Polygons have ears", 1975). One instance is reused for many
/// polygons.
/// </summary>
/// <remarks>
/// Concave polygons come out right, where a fan would cover area outside them. A polygon of n corners gives exactly n − 2 triangles, wound
/// as the polygon. Polygons that are not simple (crossing or of zero area) have no right result; they still give n − 2 triangles over
/// their corners. Cost O(n·r) for r reflex corners.
/// </remarks>
public sealed class PolygonTriangulator
{
    private readonly List<(double X, double Y)> _points = [];
    private readonly List<int> _previous = [];
    private readonly List<int> _next = [];
    private readonly List<int> _reflex = [];

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
        LinkCorners(corners.Length);
        CollectReflexCorners(corners.Length);
        ClipEars(corners.Length, triangles);
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
        return TwiceSignedArea(p3, p0, p1) > 0 && TwiceSignedArea(p0, p1, p2) > 0 && TwiceSignedArea(p1, p2, p3) > 0
            && TwiceSignedArea(p2, p3, p0) > 0;
    }

    /// <summary>Projects the corners along the longest axis of the polygon's normal (by Newell's sums), keeping the winding.</summary>
    private void Project(ReadOnlySpan<Vector> corners)
    {
        var origin = corners[0];
        var normal = Vector.Zero;
        for (var i = 0; i < corners.Length; i++)
        {
            normal += Vector.Cross(corners[i] - origin, corners[(i + 1) % corners.Length] - origin);
        }

        var size = normal.Absolute();
        _points.Clear();
        foreach (var corner in corners)
        {
            _points.Add(Project(corner - origin, normal, size));
        }
    }

    /// <summary>Projects a vector along the longest axis of a normal, whose absolute components are its size.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private static (double X, double Y) Project(Vector v, Vector normal, Vector size) =>
        size.X >= size.Y && size.X >= size.Z ? (normal.X >= 0 ? (v.Y, v.Z) : (v.Z, v.Y))
        : size.Y >= size.Z ? (normal.Y >= 0 ? (v.Z, v.X) : (v.X, v.Z))
        : normal.Z >= 0 ? (v.X, v.Y) : (v.Y, v.X);

    private void LinkCorners(int count)
    {
        _previous.Clear();
        _next.Clear();
        for (var i = 0; i < count; i++)
        {
            _previous.Add((i + count - 1) % count);
            _next.Add((i + 1) % count);
        }
    }

    /// <summary>Collects the corners that turn inwards or go straight on: only these can reach into an ear.</summary>
    /// <remarks>Clipping ears makes no other corner reflex.</remarks>
    private void CollectReflexCorners(int count)
    {
        _reflex.Clear();
        for (var corner = 0; corner < count; corner++)
        {
            if (IsReflex(corner))
            {
                _reflex.Add(corner);
            }
        }
    }

    private bool IsReflex(int corner) => TwiceSignedArea(_points[_previous[corner]], _points[corner], _points[_next[corner]]) <= 0;

    private void ClipEars(int count, List<int> triangles)
    {
        var corner = 0;
        var attempts = 0;
        for (var remaining = count; remaining > 3;)
        {
            // A corner is clipped when it is an ear or, where the polygon is not simple, once no other corner is left to try.
            if (attempts < remaining && !IsEar(corner))
            {
                corner = _next[corner];
                attempts++;
                continue;
            }

            var (previous, next) = (_previous[corner], _next[corner]);
            triangles.AddRange([previous, corner, next]);
            _next[previous] = next;
            _previous[next] = previous;
            if (_reflex.Count > 0)
            {
                _reflex.RemoveAll(reflex => reflex == corner || ((reflex == previous || reflex == next) && !IsReflex(reflex)));
            }

            // Continuing two corners later spreads the ears and avoids long thin fans.
            corner = _next[_next[corner]];
            attempts = 0;
            remaining--;
        }

        triangles.AddRange([_previous[corner], corner, _next[corner]]);
    }

    private bool IsEar(int corner)
    {
        var (previous, next) = (_previous[corner], _next[corner]);
        var points = CollectionsMarshal.AsSpan(_points);
        var (a, b, c) = (points[previous], points[corner], points[next]);
        if (TwiceSignedArea(a, b, c) <= 0)
        {
            return false;
        }

        foreach (var other in CollectionsMarshal.AsSpan(_reflex))
        {
            if (points[other] != a && points[other] != b && points[other] != c
                && TwiceSignedArea(a, b, points[other]) >= 0 && TwiceSignedArea(b, c, points[other]) >= 0
                && TwiceSignedArea(c, a, points[other]) >= 0)
            {
                return false;
            }
        }

        return true;
    }

    /// <summary>Computes twice the signed area of a triangle, positive when it is wound as the polygon.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private static double TwiceSignedArea((double X, double Y) a, (double X, double Y) b, (double X, double Y) c) =>
        ((b.X - a.X) * (c.Y - a.Y)) - ((b.Y - a.Y) * (c.X - a.X));
}
