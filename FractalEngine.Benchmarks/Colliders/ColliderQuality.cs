using FractalEngine.Benchmarks.Measuring;
using FractalEngine.Core.Colliders;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Queries;

namespace FractalEngine.Benchmarks.Colliders;

/// <summary>Measures what a collider costs beside time, and how wrong it is, as columns of benchmarks.</summary>
internal static class ColliderQuality
{
    private const int BuildRepetitions = 3;

    /// <summary>Finds the distances of positions from a mesh by testing every face.</summary>
    public static double[] ComputeOracleDistances(Mesh faces, Vector[] positions)
    {
        var simple = new SimpleCollider(faces);
        return [.. positions.AsParallel().AsOrdered().Select(position => simple.ClosestDistance(position, new QueryContext()))];
    }

    /// <summary>Builds a collider, queries it at all positions, and compares the distances with the right ones.</summary>
    /// <param name="build">Builds the collider.</param>
    /// <param name="positions">Positions of the queries, at least one.</param>
    /// <param name="maxDistance">Search radius of the queries.</param>
    /// <param name="oracle">The right distances, or null where nothing can tell them.</param>
    /// <param name="size">Diagonal of the shape.</param>
    public static IEnumerable<ExtraMetric> Measure(Func<Collider> build, Vector[] positions, double maxDistance, double[]? oracle,
        double size)
    {
        // The first build is the compiler's.
        var collider = build();
        var buildMilliseconds = InterleavedTiming.MeasureBestMilliseconds(() => collider = build(), BuildRepetitions);
        var context = new QueryContext();
        var distances = positions.Select(position => collider.ClosestDistance(position, context, maxDistance)).ToArray();
        DistanceErrors? errors = oracle is null ? null : DistanceErrors.Compare(distances, oracle, size);
        return
        [
            new("face_tests", (double)context.Statistics.FaceTests / positions.Length),
            new("bound_tests", (double)context.Statistics.BoundTests / positions.Length),
            new("largest_relative_error", errors?.MaxRelative),
            new("mean_relative_error", errors?.MeanRelative),
            new("missed_percent", errors?.MissedPercent),
            new("bytes", collider.StorageBytes),
            new("build_ms", Math.Round(buildMilliseconds, 4)),
        ];
    }
}
