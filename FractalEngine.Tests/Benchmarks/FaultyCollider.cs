using FractalEngine.Core.Colliders;
using FractalEngine.Core.Geometry.Triangles;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Queries;

namespace FractalEngine.Tests.Benchmarks;

/// <summary>A collider that changes the distances which another one finds.</summary>
/// <param name="inner">The collider that it queries.</param>
/// <param name="isExact">True for a collider that promises exact results.</param>
/// <param name="distort">Returns the distance to be told, or null for nothing found. Called in every query.</param>
internal sealed class FaultyCollider(Collider inner, bool isExact, Func<double, double?> distort) : Collider
{
    public override bool IsExact => isExact;

    public override long StorageBytes => inner.StorageBytes;

    protected override bool FindClosestCore(Vector position, double maxDistance, double epsilon, QueryContext context,
        out ClosestPoint closest)
    {
        var found = inner.TryFindClosest(position, maxDistance, context, out closest);
        var distance = distort(closest.Distance);
        closest = closest with { Distance = distance ?? 0 };
        return found && distance is not null;
    }
}
