using System.Diagnostics;
using FractalEngine.Benchmarks.Measuring;
using FractalEngine.Core.Collision;
using FractalEngine.Core.Collision.Reference;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Benchmarks.Colliders;

/// <summary>What a collider costs and how wrong it is, beside its time: columns of benchmarks.</summary>
internal static class ColliderQuality
{
    private const int BuildRepetitions = 3;

    /// <summary>The distances of positions from faces, by looking at every face.</summary>
    public static double[] ComputeOracleDistances(Mesh faces, Vector[] positions)
    {
        var simple = new SimpleCollider(faces);
        return [.. positions.AsParallel().AsOrdered()
            .Select(position => Distance(simple, position, double.PositiveInfinity, new QueryContext()))];
    }

    /// <summary>Builds a collider and asks all positions.</summary>
    /// <param name="build">The collider.</param>
    /// <param name="positions">Not empty.</param>
    /// <param name="maxDistance">How far a query looks.</param>
    /// <param name="oracle">Their distances; null where nobody knows.</param>
    /// <param name="size">The shape's diagonal.</param>
    public static IEnumerable<ExtraMetric> Measure(Func<Collider> build, Vector[] positions, double maxDistance, double[]? oracle,
        double size)
    {
        var (collider, best) = (build(), double.PositiveInfinity);
        for (var i = 0; i < BuildRepetitions; i++)
        {
            var watch = Stopwatch.StartNew();
            collider = build();
            best = Math.Min(best, watch.Elapsed.TotalMilliseconds);
        }

        var context = new QueryContext();
        var distances = positions.Select(position => Distance(collider, position, maxDistance, context)).ToArray();
        DistanceErrors? errors = oracle is null ? null : DistanceErrors.Compare(distances, oracle, size);
        return
        [
            new("face_tests", (double)context.FaceTests / positions.Length),
            new("bound_tests", (double)context.BoundTests / positions.Length),
            new("largest_relative_error", errors?.MaxRelative),
            new("mean_relative_error", errors?.MeanRelative),
            new("missed_percent", errors?.MissedPercent),
            new("bytes", collider.StorageBytes),
            new("build_ms", Math.Round(best, 4)),
        ];
    }

    private static double Distance(Collider collider, Vector position, double maxDistance, QueryContext context) =>
        collider.TryFindClosest(position, maxDistance, context, out var closest) ? closest.Distance : double.PositiveInfinity;
}
