using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Collision.Reference;

/// <summary>Looks at every face (paper §4.4.2): exact, and the reference that the others are compared with.</summary>
public sealed class SimpleCollider(Mesh mesh) : Collider
{
    /// <inheritdoc/>
    public override bool IsExact => true;

    /// <inheritdoc/>
    public override long StorageBytes => 0;

    /// <inheritdoc/>
    internal override bool SupportsTransformedQueries => true;

    /// <inheritdoc/>
    internal override bool FindClosestTransformed(Vector position, AffineMap map, double maxDistance, double epsilon, QueryContext context,
        out ClosestPoint closest)
    {
        context.ClearPath();
        context.FaceTests += mesh.FaceCount;
        var (closestDistanceSquared, closestFace) = (double.PositiveInfinity, -1);
        for (var face = 0; face < mesh.FaceCount; face++)
        {
            var (a, b, c) = mesh.Face(face);
            var distanceSquared = TriangleKernel.ClosestPoint(position, map * a, map * b, map * c).DistanceSquared;
            (closestDistanceSquared, closestFace) = distanceSquared < closestDistanceSquared
                ? (distanceSquared, face)
                : (closestDistanceSquared, closestFace);
        }

        closest = closestFace < 0 ? default : ClosestPointFactory.Create(mesh, closestFace, map, position);
        return closestFace >= 0 && closest.Distance <= maxDistance;
    }

    /// <inheritdoc/>
    protected override bool FindClosestCore(Vector position, double maxDistance, double epsilon, QueryContext context,
        out ClosestPoint closest)
    {
        context.ClearPath();
        context.FaceTests += mesh.FaceCount;
        var (closestPoint, closestFace) = (default(TrianglePoint), -1);
        for (var face = 0; face < mesh.FaceCount; face++)
        {
            var (a, b, c) = mesh.Face(face);
            var point = TriangleKernel.ClosestPoint(position, a, b, c);
            if (closestFace < 0 || point.DistanceSquared < closestPoint.DistanceSquared)
            {
                (closestPoint, closestFace) = (point, face);
            }
        }

        closest = closestFace < 0 ? default : ClosestPointFactory.Create(mesh, closestFace, closestPoint);
        return closestFace >= 0 && closest.Distance <= maxDistance;
    }
}
