using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Tests.Queries.Regions;

namespace FractalEngine.Tests.Rays;

/// <summary>
/// A ray and the plane across it. Projected along the ray, a triangle is hit where the origin of the plane lies inside it, and the distance
/// to its nearest edge says how certain that is.
/// </summary>
internal readonly struct ProjectedRay
{
    /// <summary>How far rounding may move a corner, as a part of the reach: a hundred times the last place.</summary>
    public const double CornerError = 2e-14;

    /// <summary>How far off the distance to a hit may be, as a part of the reach: what the ray casters promise.</summary>
    public const double DistanceError = 1e-12;

    private const double WeightError = 4e-15;

    private readonly Vector _across;
    private readonly Vector _up;

    public ProjectedRay(Ray ray)
    {
        Origin = ray.Origin;
        Direction = ray.Direction.UnitVector();
        var size = Direction.Absolute();
        var axis = size.X <= size.Y && size.X <= size.Z ? Vector.I : size.Y <= size.Z ? Vector.J : Vector.K;
        _across = Vector.Cross(Direction, axis).UnitVector();
        _up = Vector.Cross(Direction, _across);
    }

    public Vector Origin { get; }

    /// <summary>The direction, of length 1.</summary>
    public Vector Direction { get; }

    /// <summary>Moves the ray sideways.</summary>
    /// <param name="radius">Scene units.</param>
    /// <param name="angle">Radians.</param>
    public ProjectedRay Shift(double radius, double angle) =>
        new(new(Origin + (radius * ((Math.Cos(angle) * _across) + (Math.Sin(angle) * _up))), Direction));

    /// <summary>Tests a triangle. Where the ray misses it, or it has no area, <see cref="TriangleCrossing.Inside"/> is negative.</summary>
    public TriangleCrossing Cross(in ExpandedTriangle triangle)
    {
        var (a, b, c) = (triangle.A - Origin, triangle.B - Origin, triangle.C - Origin);
        var (ax, ay) = (Vector.Dot(a, _across), Vector.Dot(a, _up));
        var (bx, by) = (Vector.Dot(b, _across), Vector.Dot(b, _up));
        var (cx, cy) = (Vector.Dot(c, _across), Vector.Dot(c, _up));
        var area = ((bx - ax) * (cy - ay)) - ((by - ay) * (cx - ax));
        var sign = area < 0 ? -1 : 1;
        var weightA = sign * ((bx * (cy - by)) - (by * (cx - bx)));
        var weightB = sign * ((cx * (ay - cy)) - (cy * (ax - cx)));
        var weightC = sign * ((ax * (by - ay)) - (ay * (bx - ax)));
        var inside = Math.Min(
            DistanceToEdge(weightA, cx - bx, cy - by),
            Math.Min(DistanceToEdge(weightB, ax - cx, ay - cy), DistanceToEdge(weightC, bx - ax, by - ay)));
        if (!(inside >= 0))
        {
            return new(double.NegativeInfinity, double.NaN, double.PositiveInfinity, triangle.Reach);
        }

        var sum = weightA + weightB + weightC;
        var distance = ((weightA * Vector.Dot(a, Direction)) + (weightB * Vector.Dot(b, Direction)) + (weightC * Vector.Dot(c, Direction)))
            / sum;
        var reach = Math.Max(triangle.Reach, Math.Max(Origin.MaxAbsComponent(), (Origin + (distance * Direction)).MaxAbsComponent()));
        return new(inside, distance, DistanceTolerance(in triangle, reach), reach);
    }

    /// <summary>Computes how far off the distance to a triangle may be.</summary>
    /// <param name="triangle">The triangle.</param>
    /// <param name="reach">The largest absolute coordinate on the way.</param>
    public double DistanceTolerance(in ExpandedTriangle triangle, double reach)
    {
        // A corner that is off moves the hit by as much, and by more on a slope. Rounded weights move it along a needle.
        var (ab, ac) = (triangle.B - triangle.A, triangle.C - triangle.A);
        var doubledArea = Vector.Cross(ab, ac);
        var seenArea = Math.Abs(Vector.Dot(doubledArea, Direction));
        var longestSquared = Math.Max(ab.LengthSquared(), Math.Max(ac.LengthSquared(), (ac - ab).LengthSquared()));
        var error = Math.Max(CornerError * doubledArea.Length(), WeightError * longestSquared) / seenArea;
        return Math.Max(DistanceError, error) * reach;
    }

    /// <summary>Finds the distances at which the ray enters and leaves a box; the first is greater where it misses.</summary>
    public (double Enter, double Leave) Cross(Vector minimum, Vector maximum)
    {
        var (enter, leave) = (double.NegativeInfinity, double.PositiveInfinity);
        Clip(Origin.X, Direction.X, minimum.X, maximum.X, ref enter, ref leave);
        Clip(Origin.Y, Direction.Y, minimum.Y, maximum.Y, ref enter, ref leave);
        Clip(Origin.Z, Direction.Z, minimum.Z, maximum.Z, ref enter, ref leave);
        return (enter, leave);
    }

    private static void Clip(double origin, double direction, double minimum, double maximum, ref double enter, ref double leave)
    {
        if (direction == 0)
        {
            leave = origin >= minimum && origin <= maximum ? leave : double.NegativeInfinity;
            return;
        }

        var (first, second) = ((minimum - origin) / direction, (maximum - origin) / direction);
        enter = Math.Max(enter, Math.Min(first, second));
        leave = Math.Min(leave, Math.Max(first, second));
    }

    private static double DistanceToEdge(double weight, double x, double y)
    {
        var length = Math.Sqrt((x * x) + (y * y));
        return length > 0 ? weight / length : double.NegativeInfinity;
    }
}
