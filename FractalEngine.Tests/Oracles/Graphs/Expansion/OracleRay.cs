using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Tests.Oracles.Graphs.Expansion;

/// <summary>A ray with the plane across it, in which it is a point and triangles are seen from its origin.</summary>
internal readonly struct OracleRay
{
    private readonly Vector _right;
    private readonly Vector _up;

    public OracleRay(Ray ray)
    {
        Origin = ray.Origin;
        // Twice, since the squares of very short and very long directions are no doubles.
        var scaled = ray.Direction / Largest(ray.Direction);
        Direction = scaled / scaled.Length();
        var size = new Vector(Math.Abs(Direction.X), Math.Abs(Direction.Y), Math.Abs(Direction.Z));
        var axis = size.X <= size.Y && size.X <= size.Z ? Vector.I : size.Y <= size.Z ? Vector.J : Vector.K;
        var across = Vector.Cross(axis, Direction);
        _right = across / across.Length();
        _up = Vector.Cross(Direction, _right);
    }

    public Vector Origin { get; }

    /// <summary>The direction, of length 1.</summary>
    public Vector Direction { get; }

    /// <summary>Tests a triangle.</summary>
    /// <param name="triangle">A triangle of any form.</param>
    /// <param name="reach">The largest absolute coordinate of the shape and the ray.</param>
    public RayCrossing Cross(in OracleTriangle triangle, double reach)
    {
        var (a, b, c) = (triangle.A - Origin, triangle.B - Origin, triangle.C - Origin);
        var (ax, ay, az) = (Vector.Dot(a, _right), Vector.Dot(a, _up), Vector.Dot(a, Direction));
        var (bx, by, bz) = (Vector.Dot(b, _right), Vector.Dot(b, _up), Vector.Dot(b, Direction));
        var (cx, cy, cz) = (Vector.Dot(c, _right), Vector.Dot(c, _up), Vector.Dot(c, Direction));
        // By edges, since corners that are far away differ by little.
        var (areaA, areaB, areaC) = (Cross(bx, by, cx - bx, cy - by), Cross(cx, cy, ax - cx, ay - cy), Cross(ax, ay, bx - ax, by - ay));
        var toEdge = Math.Min(
            DistanceToSegment(ax, ay, bx, by), Math.Min(DistanceToSegment(bx, by, cx, cy), DistanceToSegment(cx, cy, ax, ay)));
        var hasOneSign = (areaA >= 0 && areaB >= 0 && areaC >= 0) || (areaA <= 0 && areaB <= 0 && areaC <= 0);
        var area = areaA + areaB + areaC;
        // Far from a thin triangle signs are those of rounding. No place inside is farther from all edges than the middle of the incircle.
        var perimeter = Length(bx - ax, by - ay) + Length(cx - bx, cy - by) + Length(ax - cx, ay - cy);
        var inradius = Math.Abs(Cross(bx - ax, by - ay, cx - ax, cy - ay)) / perimeter;
        var isInside = hasOneSign && area != 0 && toEdge <= 1.001 * inradius;
        var (nearest, farthest) = (Math.Min(az, Math.Min(bz, cz)), Math.Max(az, Math.Max(bz, cz)));
        var distance = area == 0 ? nearest : Math.Clamp(((areaA * az) + (areaB * bz) + (areaC * cz)) / area, nearest, farthest);
        return new(isInside ? toEdge : -toEdge, distance, Tolerance(in triangle, reach), farthest);
    }

    // A corner that is off moves the hit by as much, and by more on a slope; along a needle rounded areas do.
    private double Tolerance(in OracleTriangle triangle, double reach)
    {
        var (ab, ac) = (triangle.B - triangle.A, triangle.C - triangle.A);
        var normal = Vector.Cross(ab, ac);
        var seen = Math.Abs(Vector.Dot(normal, Direction));
        var longest = triangle.LongestEdge;
        var slope = Math.Max(RayCrossing.CornerError * normal.Length(), 4e-15 * longest * longest) / seen;
        return Math.Max(RayCrossing.DistanceError, slope) * reach;
    }

    private static double DistanceToSegment(double x1, double y1, double x2, double y2)
    {
        var (x, y) = (x2 - x1, y2 - y1);
        var lengthSquared = (x * x) + (y * y);
        var place = lengthSquared > 0 ? Math.Clamp(-((x1 * x) + (y1 * y)) / lengthSquared, 0, 1) : 0;
        if (place is > 0 and < 1)
        {
            // By the area, since the product of place and edge would be rounded.
            return Math.Abs(Cross(x1, y1, x, y)) / Math.Sqrt(lengthSquared);
        }

        return place == 0 ? Length(x1, y1) : Length(x2, y2);
    }

    private static double Cross(double x1, double y1, double x2, double y2) => (x1 * y2) - (y1 * x2);

    private static double Length(double x, double y) => Math.Sqrt((x * x) + (y * y));

    private static double Largest(Vector v) => Math.Max(Math.Abs(v.X), Math.Max(Math.Abs(v.Y), Math.Abs(v.Z)));
}
