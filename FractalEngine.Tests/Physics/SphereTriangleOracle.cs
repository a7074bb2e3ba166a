using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Tests.Physics;

/// <summary>
/// Distances and impacts of spheres on triangles by plain geometry, face by face. It shares nothing with the engine's colliders.
/// </summary>
internal sealed class SphereTriangleOracle((Vector A, Vector B, Vector C)[] faces)
{
    public SphereTriangleOracle(Mesh mesh) : this(PhysicsMeshes.TrianglesOf(mesh))
    {
    }

    // A face whose height is a smaller part of its longest edge is as far away as its edges are: what is missed is the square of that.
    private const double SliverHeight = 1e-7;

    /// <summary>Finds the distance of a position from the closest face.</summary>
    public double Distance(Vector position)
    {
        var closest = double.PositiveInfinity;
        foreach (var (a, b, c) in faces)
        {
            closest = Math.Min(closest, DistanceToTriangle(position, a, b, c));
        }

        return closest;
    }

    /// <summary>
    /// Finds when and where a sphere on a straight path first touches a face; null where it never does. At first it must overlap none.
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

    private static double DistanceToTriangle(Vector position, Vector a, Vector b, Vector c)
    {
        var cross = Vector.Cross(b - a, c - a);
        var longest = Math.Max((b - a).LengthSquared(), Math.Max((c - b).LengthSquared(), (a - c).LengthSquared()));
        var isSliver = cross.Length() <= SliverHeight * longest;
        var normal = isSliver ? Vector.Zero : cross.UnitVector();
        return !isSliver && IsInside(position, a, b, c, normal)
            ? Math.Abs(Vector.Dot(position - a, normal))
            : Math.Min(DistanceToEdge(position, a, b), Math.Min(DistanceToEdge(position, b, c), DistanceToEdge(position, c, a)));
    }

    private static double DistanceToEdge(Vector position, Vector a, Vector b)
    {
        var along = a == b ? 0 : Vector.Dot(position - a, b - a) / (b - a).LengthSquared();
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
        var startAcross = start - a - (Vector.Dot(start - a, axis) * axis);
        var velocityAcross = velocity - (Vector.Dot(velocity, axis) * axis);
        if (FirstRoot(startAcross, velocityAcross, radius) is not { } time)
        {
            return null;
        }

        var along = Vector.Dot(start + (time * velocity) - a, axis);
        return along >= 0 && along <= (b - a).Length() ? (time, a + (along * axis)) : null;
    }

    private static (double Time, Vector Point)? HitVertex(Vector start, Vector velocity, double radius, Vector vertex) =>
        FirstRoot(start - vertex, velocity, radius) is { } time ? (time, vertex) : null;

    /// <summary>Finds the first t at which |from + t·velocity| = radius; null where the sphere passes.</summary>
    private static double? FirstRoot(Vector from, Vector velocity, double radius)
    {
        // The coefficients of a·t² + 2·b·t + c = 0.
        var a = velocity.LengthSquared();
        var b = Vector.Dot(from, velocity);
        var c = from.LengthSquared() - (radius * radius);
        var discriminant = (b * b) - (a * c);
        return b < 0 && discriminant >= 0 ? c / (-b + Math.Sqrt(discriminant)) : null;
    }
}
