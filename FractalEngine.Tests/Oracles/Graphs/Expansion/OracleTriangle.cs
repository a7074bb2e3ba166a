using FractalEngine.Core.Maths;

namespace FractalEngine.Tests.Oracles.Graphs.Expansion;

/// <summary>A triangle of an expansion.</summary>
/// <param name="A">The first corner.</param>
/// <param name="B">The second corner.</param>
/// <param name="C">The third corner.</param>
/// <param name="Instance">Index of its instance.</param>
/// <param name="Face">Index of the face in the base mesh.</param>
/// <param name="Reach">The largest absolute coordinate on the way to it, which rounding is measured against.</param>
internal readonly record struct OracleTriangle(Vector A, Vector B, Vector C, int Instance, int Face, double Reach)
{
    public double LongestEdge => Math.Max((B - A).Length(), Math.Max((C - B).Length(), (A - C).Length()));

    /// <summary>The point of the two barycentrics of the second and the third corner.</summary>
    public Vector Point(double u, double v) => A + (u * (B - A)) + (v * (C - A));

    /// <summary>
    /// Finds the closest point: the foot of the perpendicular where it lies inside, otherwise the closest point of an edge. The foot is
    /// made of the longest edge and the altitude on it, so that needles and triangles without area are no special cases.
    /// </summary>
    public Vector ClosestPoint(Vector position)
    {
        var closest = Nearer(
            position,
            ClosestOnSegment(position, A, B),
            Nearer(position, ClosestOnSegment(position, B, C), ClosestOnSegment(position, C, A)));
        return TryFindFoot(position, out var foot) ? Nearer(position, foot, closest) : closest;
    }

    private bool TryFindFoot(Vector position, out Vector foot)
    {
        var (a, b, c) = WithLongestEdgeFirst();
        foot = default;
        var length = (b - a).Length();
        if (!(length > 0))
        {
            return false;
        }

        var along = (b - a) / length;
        var place = Vector.Dot(c - a, along);
        var altitude = c - a - (place * along);
        // What is left along the edge is that of rounding.
        altitude -= Vector.Dot(altitude, along) * along;
        var height = altitude.Length();
        if (!(height > 0))
        {
            return false;
        }

        var up = altitude / height;
        var x = Vector.Dot(position - a, along);
        var y = Vector.Dot(position - a - (x * along), up);
        foot = a + (x * along) + (y * up);
        return y >= 0 && y <= height && x * height >= place * y && (length - x) * height >= (length - place) * y;
    }

    private (Vector First, Vector Second, Vector Third) WithLongestEdgeFirst()
    {
        var (ab, bc, ca) = ((B - A).LengthSquared(), (C - B).LengthSquared(), (A - C).LengthSquared());
        return ab >= bc && ab >= ca ? (A, B, C) : bc >= ca ? (B, C, A) : (C, A, B);
    }

    private static Vector Nearer(Vector position, Vector point1, Vector point2) =>
        (point1 - position).LengthSquared() <= (point2 - position).LengthSquared() ? point1 : point2;

    private static Vector ClosestOnSegment(Vector position, Vector start, Vector end)
    {
        var edge = end - start;
        var lengthSquared = edge.LengthSquared();
        var place = lengthSquared > 0 ? Math.Clamp(Vector.Dot(position - start, edge) / lengthSquared, 0, 1) : 0;
        // From the nearer end, so that the far one of a long edge is met exactly.
        return place <= 0.5 ? start + (place * edge) : end - ((1 - place) * edge);
    }
}
