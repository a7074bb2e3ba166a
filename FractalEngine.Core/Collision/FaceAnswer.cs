using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Collision;

/// <summary>Completes what the kernel found on a face to the answer of a query.</summary>
internal static class FaceAnswer
{
    /// <summary>On a face of a mesh.</summary>
    public static ClosestPoint Of(Mesh mesh, int face, FacePoint point) => mesh.Face(face) switch
    {
        var (a, b, c) => Of(a, b, c, face, point),
    };

    /// <summary>On a face of an instance: looked at once more in the frame of the query, where its answer is needed.</summary>
    public static ClosestPoint Of(Mesh mesh, int face, AffineMap instance, Vector position)
    {
        var (a, b, c) = mesh.Face(face);
        (a, b, c) = (instance * a, instance * b, instance * c);
        return Of(a, b, c, face, FaceKernel.ClosestPoint(position, a, b, c));
    }

    private static ClosestPoint Of(Vector a, Vector b, Vector c, int face, FacePoint point) => new(
        Math.Sqrt(point.DistanceSquared), point.Point, FaceKernel.UnitNormal(a, b, c), point.Barycentrics, point.Feature, face);
}
