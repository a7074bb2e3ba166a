using FractalEngine.Core.Collision;
using FractalEngine.Core.Maths;

namespace FractalEngine.Tests.Benchmarks;

/// <summary>A collider that promises what another one keeps, and says what it likes.</summary>
/// <param name="inner">Whom it asks.</param>
/// <param name="isExact">What it promises.</param>
/// <param name="distort">What it makes of the distance; null for nothing found.</param>
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
