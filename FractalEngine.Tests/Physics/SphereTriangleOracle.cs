using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Tests.Physics;

/// <summary>Balls and triangles by school geometry, every face each time. It shares nothing with the engine's colliders.</summary>
internal sealed class SphereTriangleOracle((Vector A, Vector B, Vector C)[] faces)
{
    public SphereTriangleOracle(Mesh mesh) : this(PhysicsMeshes.TrianglesOf(mesh))
    {
    }

    public double Distance(Vector position)
    {
        var closest = double.PositiveInfinity;
        foreach (var (a, b, c) in faces)
        {
            closest = Math.Min(closest, Distance(position, a, b, c));
        }

        return closest;
    }

    /// <summary>
    /// When a ball on a straight way first touches a face, and where; null where it never does. It must overlap none at first.
    /// </summary>
    public (double Time, Vector Point)? FindFirstHit(Vector start, Vector velocity, double radius)
    {
        (double Time, Vector Point)? first = null;
        foreach (var (a, b, c) in faces)
        {
            KeepEarlier(ref first, HitInterior(start, velocity, radius, a, b, c));
            KeepEarlier(ref first, HitEdge(start, velocity, radius, a, b));
            KeepEarlier(ref first, HitEdge(start, velocity, radius, b, c));
            KeepEarlier(ref first, HitEdge(start, velocity, radius, c, a));
            KeepEarlier(ref first, HitVertex(start, velocity, radius, a));
            KeepEarlier(ref first, HitVertex(start, velocity, radius, b));
            KeepEarlier(ref first, HitVertex(start, velocity, radius, c));
        }

        return first;
    }

    private static void KeepEarlier(ref (double Time, Vector Point)? first, (double Time, Vector Point)? other)
    {
        if (other is { Time: >= 0 } hit && !(hit.Time >= first?.Time))
        {
            first = hit;
        }
    }

    private static double Distance(Vector position, Vector a, Vector b, Vector c)
    {
        var normal = Vector.Cross(b - a, c - a).UnitVector();
        var height = Vector.Dot(position - a, normal);
        return IsInside(position, a, b, c, normal)
            ? Math.Abs(height)
            : Math.Min(Distance(position, a, b), Math.Min(Distance(position, b, c), Distance(position, c, a)));
    }

    private static double Distance(Vector position, Vector a, Vector b)
    {
        var along = Vector.Dot(position - a, b - a) / (b - a).LengthSquared();
        return (position - a - (Math.Clamp(along, 0, 1) * (b - a))).Length();
    }

    private static bool IsInside(Vector position, Vector a, Vector b, Vector c, Vector normal) =>
        Vector.Dot(Vector.Cross(b - a, position - a), normal) >= 0
        && Vector.Dot(Vector.Cross(c - b, position - b), normal) >= 0
        && Vector.Dot(Vector.Cross(a - c, position - c), normal) >= 0;

    private static (double Time, Vector Point)? HitInterior(Vector start, Vector velocity, double radius, Vector a, Vector b, Vector c)
    {
        var normal = Vector.Cross(b - a, c - a).UnitVector();
        var towards = Vector.Dot(start - a, normal) < 0 ? -normal : normal;
        var time = (Vector.Dot(start - a, towards) - radius) / -Vector.Dot(velocity, towards);
        var point = start + (time * velocity) - (radius * towards);
        return double.IsFinite(time) && Vector.Dot(velocity, towards) < 0 && IsInside(point, a, b, c, normal) ? (time, point) : null;
    }

    private static (double Time, Vector Point)? HitEdge(Vector start, Vector velocity, double radius, Vector a, Vector b)
    {
        var axis = (b - a).UnitVector();
        var (from, across) = (start - a - (Vector.Dot(start - a, axis) * axis), velocity - (Vector.Dot(velocity, axis) * axis));
        if (FirstRoot(from, across, radius) is not { } time)
        {
            return null;
        }

        var along = Vector.Dot(start + (time * velocity) - a, axis);
        return along >= 0 && along <= (b - a).Length() ? (time, a + (along * axis)) : null;
    }

    private static (double Time, Vector Point)? HitVertex(Vector start, Vector velocity, double radius, Vector vertex) =>
        FirstRoot(start - vertex, velocity, radius) is { } time ? (time, vertex) : null;

    /// <summary>The first t at which |from + t·velocity| = radius.</summary>
    private static double? FirstRoot(Vector from, Vector velocity, double radius)
    {
        var (square, half, rest) = (velocity.LengthSquared(), Vector.Dot(from, velocity), from.LengthSquared() - (radius * radius));
        var discriminant = (half * half) - (square * rest);
        return half < 0 && discriminant >= 0 ? rest / (-half + Math.Sqrt(discriminant)) : null;
    }
}
