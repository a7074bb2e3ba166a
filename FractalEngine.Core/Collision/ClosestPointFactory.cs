using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Collision;

/// <summary>Completes what the kernel found on a face to the answer of a query.</summary>
internal static class ClosestPointFactory
{
    /// <summary>On a face of a mesh.</summary>
    public static ClosestPoint Create(Mesh mesh, int face, TrianglePoint point) => mesh.Face(face) switch
    {
        var (a, b, c) => Create(a, b, c, face, point),
    };

    /// <summary>On a face of an instance: looked at once more in the frame of the query, where its answer is needed.</summary>
    public static ClosestPoint Create(Mesh mesh, int face, AffineMap map, Vector position)
    {
        var (a, b, c) = mesh.Face(face);
        (a, b, c) = (map * a, map * b, map * c);
        return Create(a, b, c, face, TriangleKernel.ClosestPoint(position, a, b, c));
    }

    private static ClosestPoint Create(Vector a, Vector b, Vector c, int face, TrianglePoint point) => new(
        Math.Sqrt(point.DistanceSquared), point.Point, TriangleKernel.UnitNormal(a, b, c), point.Barycentrics, point.Feature, face);
}
