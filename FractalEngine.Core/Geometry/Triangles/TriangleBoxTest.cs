using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Geometry.Triangles;

/// <summary>Tests whether a triangle meets a closed box, by separating axes.</summary>
/// <remarks>
/// They are the three axes of the box, the normal of the triangle, and the nine products of their edges (Akenine-Möller 2001). Along the
/// axes of the box coordinates are compared as they are. Along the others a gap counts from 4e-15 of the largest coordinate on, which is
/// more than rounding makes. So no face that meets the box is missed, and one that is closer than that may count. Beyond the tip of a
/// needle, gaps along all axes may be smaller than the distance; that is why the ball around the box is tested, too.
/// </remarks>
internal static class TriangleBoxTest
{
    /// <summary>Tells whether two closed boxes meet.</summary>
    /// <param name="box1">The first box, not empty.</param>
    /// <param name="box2">The second box, not empty.</param>
    /// <param name="tolerance">Boxes that are no farther apart along an axis count as meeting.</param>
    public static bool Meets(BoundingBox box1, BoundingBox box2, double tolerance)
    {
        var gap = Vector.Max(box1.Minimum - box2.Maximum, box2.Minimum - box1.Maximum);
        return gap.X <= tolerance && gap.Y <= tolerance && gap.Z <= tolerance;
    }

    /// <summary>Tells whether the triangle abc meets a box.</summary>
    /// <param name="a">The first vertex of the triangle.</param>
    /// <param name="b">The second vertex of the triangle.</param>
    /// <param name="c">The third vertex of the triangle.</param>
    /// <param name="box">The box, not empty.</param>
    /// <param name="tolerance">Distance up to which the triangle may count as meeting, beside rounding.</param>
    public static bool Meets(Vector a, Vector b, Vector c, BoundingBox box, double tolerance)
    {
        if (!Meets(new(Vector.Min(a, Vector.Min(b, c)), Vector.Max(a, Vector.Max(b, c))), box, tolerance))
        {
            return false;
        }

        var centre = box.Centre;
        var halfSize = (0.5 * box.Size) + (tolerance * Vector.One);
        var magnitude = Math.Max(
            Math.Max(a.MaxAbsComponent(), Math.Max(b.MaxAbsComponent(), c.MaxAbsComponent())),
            centre.MaxAbsComponent() + halfSize.MaxAbsComponent());
        var rounding = RoundingErrors.Coordinate * magnitude;
        a -= centre;
        b -= centre;
        c -= centre;
        var ab = b - a;
        var bc = c - b;
        var ca = a - c;
        return !Separates(Vector.Cross(ab, -ca), a, b, c, halfSize, rounding)
            && !SeparatesAlongEdge(ab, a, b, c, halfSize, rounding)
            && !SeparatesAlongEdge(bc, a, b, c, halfSize, rounding)
            && !SeparatesAlongEdge(ca, a, b, c, halfSize, rounding)
            && IsInReach(a, b, c, halfSize, rounding);
    }

    /// <summary>Tests the products of an edge with the axes of the box.</summary>
    private static bool SeparatesAlongEdge(Vector edge, Vector a, Vector b, Vector c, Vector halfSize, double rounding) =>
        Separates(new(0, -edge.Z, edge.Y), a, b, c, halfSize, rounding)
        || Separates(new(edge.Z, 0, -edge.X), a, b, c, halfSize, rounding)
        || Separates(new(-edge.Y, edge.X, 0), a, b, c, halfSize, rounding);

    /// <summary>Tells whether a triangle meets the ball around the box, whose centre is the origin.</summary>
    private static bool IsInReach(Vector a, Vector b, Vector c, Vector halfSize, double rounding)
    {
        var distance = Math.Sqrt(TriangleKernel.ClosestPoint(Vector.Zero, a, b, c).DistanceSquared);
        return !(distance > halfSize.Length() + (2 * rounding));
    }

    private static bool Separates(Vector axis, Vector a, Vector b, Vector c, Vector halfSize, double rounding)
    {
        var (x, y, z) = axis.Absolute();
        var reach = Vector.Dot(new(x, y, z), halfSize) + (rounding * (x + y + z));
        var (heightA, heightB, heightC) = (Vector.Dot(axis, a), Vector.Dot(axis, b), Vector.Dot(axis, c));
        return Math.Min(heightA, Math.Min(heightB, heightC)) > reach || Math.Max(heightA, Math.Max(heightB, heightC)) < -reach;
    }
}
