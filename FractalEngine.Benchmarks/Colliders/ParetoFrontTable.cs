using System.Diagnostics;
using FractalEngine.Benchmarks.Measuring;
using FractalEngine.Core.Colliders;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Queries;

namespace FractalEngine.Benchmarks.Colliders;

/// <summary>
/// Which collider for which error? The table has a row for each shape, kind of position, collider and value of its parameter. A row holds
/// time and tests of a query, errors, missed collisions, and bytes.
/// </summary>
/// <remarks>
/// The oracle tests every face (<see cref="SimpleCollider"/>); shapes with too many faces have no errors. Times are the smallest of some
/// rounds, in which all rows of a shape take turns, on one thread. Slow rows are timed on the first positions only; their tests and errors
/// are those of all. Caches are warm. Only times differ from run to run.
/// </remarks>
/// <param name="queries">Number of positions of each kind.</param>
/// <param name="rounds">Number of rounds for the times.</param>
/// <param name="table">Table that receives the rows.</param>
internal sealed class ParetoFrontTable(int queries, int rounds, CsvTable table)
{
    /// <summary>Names of the table's columns.</summary>
    public static readonly string[] Columns =
    [
        "shape", "faces", "queries", "collider", "knob", "value", "query_ns", "face_tests", "bound_tests", "largest_error", "mean_error",
        "largest_relative_error", "mean_relative_error", "missed_percent", "bytes", "build_ms",
    ];

    // Tests that a row may spend in a round, and the fewest positions it is timed on.
    private const double MaxTestsPerRound = 1_000_000;
    private const int MinTimedPositions = 4;

    private readonly QueryContext _context = new();

    /// <summary>Shortest time for which rounds go on, so that the compiler has done its best in the last ones.</summary>
    public TimeSpan WarmUpDuration { get; init; } = TimeSpan.FromSeconds(1);

    /// <summary>Adds the rows of all variants that suit a shape.</summary>
    /// <exception cref="InvalidDataException">
    /// A collider broke its promise: an exact one erred, one with ε erred by more than that, or one found a point closer than every face.
    /// </exception>
    public void Add(BenchmarkShape shape) => Add(shape, ColliderVariant.CreateAll(shape));

    /// <summary>Adds the rows of some variants.</summary>
    /// <exception cref="InvalidDataException">A collider broke its promise, as above.</exception>
    public void Add(BenchmarkShape shape, IReadOnlyList<ColliderVariant> rows)
    {
        Add(shape, rows, "uniform", shape.RandomInBounds);
        Add(shape, rows, "near", shape.RandomNearSurface);
    }

    private void Add(BenchmarkShape shape, IReadOnlyList<ColliderVariant> rows, string kind, Func<Random, Vector> createPosition)
    {
        var random = new Random(1);
        var positions = Enumerable.Range(0, queries).Select(_ => createPosition(random)).ToArray();
        var oracle = shape.Faces is null ? null : ColliderQuality.ComputeOracleDistances(shape.Faces, positions);
        var results = rows.Select(row => RunQueries(row, positions, oracle)).ToArray();
        if (oracle is not null)
        {
            foreach (var (row, result) in rows.Zip(results))
            {
                ThrowIfInaccurate(shape, row, result.Distances, oracle);
            }
        }

        var timedCounts = results.Select(result => TimedPositionCount(result.FaceTests + result.BoundTests)).ToArray();
        var times = MeasureTimes(rows, positions, timedCounts);
        for (var i = 0; i < rows.Count; i++)
        {
            var (row, result) = (rows[i], results[i]);
            DistanceErrors? errors = oracle is null ? null : DistanceErrors.Compare(result.Distances, oracle, shape.Size);
            table.Add(
                shape.Name, shape.Faces?.FaceCount, kind, row.ColliderName, row.ParameterName, row.ParameterValue,
                Math.Round(times[i], 1), result.FaceTests, result.BoundTests,
                errors?.Max, errors?.Mean, errors?.MaxRelative, errors?.MeanRelative, errors?.MissedPercent,
                row.Bytes, Math.Round(row.BuildMilliseconds, 2));
        }
    }

    /// <summary>Queries a row at all positions. The collider that is the oracle gets one query, for its costs only.</summary>
    private (double[] Distances, double FaceTests, double BoundTests) RunQueries(ColliderVariant row, Vector[] positions, double[]? oracle)
    {
        _context.Statistics.Reset();
        var queried = row.Collider is SimpleCollider ? positions[..1] : positions;
        var distances = queried
            .Select(position => row.Collider.ClosestDistance(position, _context, double.PositiveInfinity, row.Epsilon)).ToArray();
        return (queried.Length < positions.Length ? oracle! : distances, (double)_context.Statistics.FaceTests / queried.Length,
            (double)_context.Statistics.BoundTests / queried.Length);
    }

    private static void ThrowIfInaccurate(BenchmarkShape shape, ColliderVariant row, double[] distances, double[] oracle)
    {
        var rounding = DistanceErrors.RoundingTolerance * shape.Size;
        for (var i = 0; i < oracle.Length; i++)
        {
            var maxDistance = row.Collider.IsExact ? ((1 + row.Epsilon) * oracle[i]) + rounding : double.PositiveInfinity;
            if (!(distances[i] >= oracle[i] - rounding && distances[i] <= maxDistance))
            {
                var variant = FormattableString.Invariant($"{row.ColliderName} {row.ParameterName} {row.ParameterValue}");
                throw new InvalidDataException(FormattableString.Invariant(
                    $"{shape.Name}, {variant}, position {i}: found {distances[i]:R} where every face gives {oracle[i]:R}"));
            }
        }
    }

    private int TimedPositionCount(double tests) =>
        Math.Clamp((int)(MaxTestsPerRound / Math.Max(tests, 1)), Math.Min(MinTimedPositions, queries), queries);

    /// <summary>Measures the nanoseconds of a query for each row.</summary>
    private double[] MeasureTimes(IReadOnlyList<ColliderVariant> rows, Vector[] positions, int[] counts)
    {
        var best = new double[rows.Count];
        Array.Fill(best, double.PositiveInfinity);
        var watch = Stopwatch.StartNew();
        for (var round = 0; round < rounds || watch.Elapsed < WarmUpDuration; round++)
        {
            for (var i = 0; i < best.Length; i++)
            {
                // Each row runs once untimed. Otherwise the first with a structure of megabytes brings it into the caches for the others.
                MeasureTime(rows[i], positions.AsSpan(0, counts[i]));
                best[i] = Math.Min(best[i], MeasureTime(rows[i], positions.AsSpan(0, counts[i])));
            }
        }

        return best;
    }

    private double MeasureTime(ColliderVariant row, ReadOnlySpan<Vector> positions)
    {
        var start = Stopwatch.GetTimestamp();
        foreach (var position in positions)
        {
            row.Collider.TryFindClosest(position, double.PositiveInfinity, _context, out _, row.Epsilon);
        }

        return Stopwatch.GetElapsedTime(start).TotalNanoseconds / positions.Length;
    }
}
