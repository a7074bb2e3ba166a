using FractalEngine.Core.Colliders;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Queries;

namespace FractalEngine.Benchmarks.Measuring;

/// <summary>Queries of which only the distance is wanted.</summary>
internal static class ColliderQueries
{
    /// <summary>Finds the distance of the closest point, infinite where none lies within the search radius.</summary>
    public static double ClosestDistance(
        this Collider collider, Vector position, QueryContext context, double maxDistance = double.PositiveInfinity, double epsilon = 0) =>
        collider.TryFindClosest(position, maxDistance, context, out var closest, epsilon) ? closest.Distance : double.PositiveInfinity;

    /// <summary>Adds up the distances that some queries find, so that no query is optimised away.</summary>
    public static double SumDistances(
        this Collider collider, ReadOnlySpan<Vector> positions, QueryContext context, double maxDistance = double.PositiveInfinity)
    {
        var sum = 0.0;
        foreach (var position in positions)
        {
            sum += collider.TryFindClosest(position, maxDistance, context, out var closest) ? closest.Distance : 0;
        }

        return sum;
    }
}
