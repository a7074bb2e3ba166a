using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Geometry.Triangles;

/// <summary>Completes the closest point of a triangle to the result of a query.</summary>
internal static class ClosestPointFactory
{
    /// <summary>Creates the result for a triangle of a mesh.</summary>
    /// <param name="mesh">The mesh, in the frame of the query.</param>
    /// <param name="face">Face index of the triangle.</param>
    /// <param name="point">The closest point of the triangle.</param>
    public static ClosestPoint OnMesh(Mesh mesh, int face, TrianglePoint point)
    {
        var (a, b, c) = mesh.Face(face);
        return Create(a, b, c, face, point);
    }

    /// <summary>Creates the result for a triangle of a mesh, which is tested once more.</summary>
    /// <param name="mesh">The mesh, in the frame of the query.</param>
    /// <param name="face">Face index of the triangle.</param>
    /// <param name="position">In the frame of the query.</param>
    public static ClosestPoint OnMesh(Mesh mesh, int face, Vector position)
    {
        var (a, b, c) = mesh.Face(face);
        return Create(a, b, c, face, TriangleKernel.ClosestPoint(position, a, b, c));
    }

    /// <summary>Creates the result for a triangle of an instance, which is tested once more in the frame of the query.</summary>
    /// <param name="mesh">The mesh of the instance.</param>
    /// <param name="face">Face index of the triangle.</param>
    /// <param name="map">From the mesh's frame to that of the query.</param>
    /// <param name="position">In the frame of the query.</param>
    public static ClosestPoint OnInstance(Mesh mesh, int face, AffineMap map, Vector position)
    {
        OnInstance(mesh, face, new SimdAffineMap(map), in position, out var closest);
        return closest;
    }

    /// <summary>Creates the result for a triangle of an instance, which is tested once more in the frame of the query.</summary>
    /// <param name="mesh">The mesh of the instance.</param>
    /// <param name="face">Face index of the triangle.</param>
    /// <param name="map">From the mesh's frame to that of the query.</param>
    /// <param name="position">In the frame of the query.</param>
    /// <param name="closest">The result.</param>
    public static void OnInstance(Mesh mesh, int face, in SimdAffineMap map, in Vector position, out ClosestPoint closest)
    {
        var (a, b, c) = mesh.Face(face);
        (a, b, c) = (map.Apply(a), map.Apply(b), map.Apply(c));
        var point = TriangleKernel.ClosestPoint(position, a, b, c);
        closest = new(
            Math.Sqrt(point.DistanceSquared), point.Point, TriangleKernel.UnitNormal(a, b, c), point.Barycentrics, point.Feature, face);
    }

    private static ClosestPoint Create(Vector a, Vector b, Vector c, int face, TrianglePoint point) => new(
        Math.Sqrt(point.DistanceSquared), point.Point, TriangleKernel.UnitNormal(a, b, c), point.Barycentrics, point.Feature, face);
}
