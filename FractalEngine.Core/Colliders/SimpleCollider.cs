using FractalEngine.Core.Geometry;
using FractalEngine.Core.Geometry.Triangles;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Queries;
using FractalEngine.Core.Queries.Regions;

namespace FractalEngine.Core.Colliders;

/// <summary>Tests every triangle (paper §4.4.2). Exact, and the reference that the other colliders are compared with.</summary>
/// <param name="mesh">The mesh, of which nothing is copied.</param>
public sealed class SimpleCollider(Mesh mesh) : Collider
{
    private readonly double _magnitude = QueryScale.Magnitude(mesh);

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
        var magnitude = QueryScale.Magnitude(in position, in map, _magnitude);
        if (QueryScale.IsNeeded(magnitude))
        {
            return ScaledQuery.FindClosest(this, in position, in map, magnitude, maxDistance, epsilon, context, out closest);
        }

        context.ClearPath();
        context.Statistics.FaceTests += mesh.FaceCount;
        var closestDistanceSquared = double.PositiveInfinity;
        var closestFace = -1;
        for (var face = 0; face < mesh.FaceCount; face++)
        {
            var (a, b, c) = mesh.Face(face);
            var distanceSquared = TriangleKernel.ClosestPoint(position, map * a, map * b, map * c).DistanceSquared;
            if (distanceSquared < closestDistanceSquared)
            {
                closestDistanceSquared = distanceSquared;
                closestFace = face;
            }
        }

        closest = closestFace < 0 ? default : ClosestPointFactory.OnInstance(mesh, closestFace, map, position);
        return closestFace >= 0 && closest.Distance <= maxDistance;
    }

    /// <inheritdoc/>
    private protected override ShapeTree CreateShapeTree() => new(mesh, bvh: null);

    /// <inheritdoc/>
    protected override bool FindClosestCore(Vector position, double maxDistance, double epsilon, QueryContext context,
        out ClosestPoint closest)
    {
        var magnitude = Math.Max(position.MaxAbsComponent(), _magnitude);
        if (QueryScale.IsNeeded(magnitude))
        {
            return ScaledQuery.FindClosest(
                this, in position, AffineMap.Identity, magnitude, maxDistance, epsilon, context, out closest);
        }

        context.ClearPath();
        context.Statistics.FaceTests += mesh.FaceCount;
        var scan = new TriangleScan(mesh, position);
        for (var face = 0; face < mesh.FaceCount; face++)
        {
            scan.Test(face);
        }

        closest = scan.ClosestFace < 0 ? default : ClosestPointFactory.OnMesh(mesh, scan.ClosestFace, scan.ClosestPoint);
        return scan.ClosestFace >= 0 && closest.Distance <= maxDistance;
    }
}
