using System.Diagnostics;
using FractalEngine.Benchmarks.Measuring;
using FractalEngine.Core.Collision;
using FractalEngine.Core.Collision.Reference;
using FractalEngine.Core.Maths;

namespace FractalEngine.Benchmarks.Colliders;

/// <summary>
/// Which collider for which error? A row for each shape, kind of position, collider and place of its knob: time and tests a query, errors,
/// collisions missed, bytes.
/// </summary>
/// <remarks>
/// The oracle looks at every face (<see cref="SimpleCollider"/>); shapes with too many have no errors. Times are the smallest of some
/// rounds, in which all rows of a shape take turns, on one thread. Slow rows are timed on the first positions only; tests and errors are
/// those of all. Caches are warm. Only times differ from run to run.
/// </remarks>
/// <param name="queries">Of each kind.</param>
/// <param name="rounds">For times.</param>
/// <param name="table">Receives the rows.</param>
internal sealed class FrontTable(int queries, int rounds, CsvTable table)
{
    /// <summary>Names of the columns.</summary>
    public static readonly string[] Columns =
    [
        "shape", "faces", "queries", "collider", "knob", "value", "query_ns", "face_tests", "bound_tests", "largest_error", "mean_error",
        "largest_relative_error", "mean_relative_error", "missed_percent", "bytes", "build_ms",
    ];

    // Tests that a row may spend in a round, and the fewest positions it is timed on.
    private const double TestsOfRound = 1_000_000;
    private const int FewestTimed = 4;

    private readonly QueryContext _record = new();

    /// <summary>Rounds are made for at least so long, so that the compiler has done its best in the last ones.</summary>
    public TimeSpan WarmUp { get; init; } = TimeSpan.FromSeconds(1);

    /// <summary>Adds the rows of a shape.</summary>
    /// <exception cref="InvalidDataException">
    /// A collider broke its promise: an exact one erred, one with ε by more than it, or one found something nearer than every face.
    /// </exception>
    public void Add(FrontShape shape) => Add(shape, FrontRow.All(shape));

    /// <summary>Adds some rows of a shape.</summary>
    /// <exception cref="InvalidDataException">As above.</exception>
    public void Add(FrontShape shape, IReadOnlyList<FrontRow> rows)
    {
        Add(shape, rows, "uniform", shape.Uniform);
        Add(shape, rows, "near", shape.Near);
    }

    private void Add(FrontShape shape, IReadOnlyList<FrontRow> rows, string kind, Func<Random, Vector> make)
    {
        var random = new Random(1);
        var positions = Enumerable.Range(0, queries).Select(_ => make(random)).ToArray();
        var oracle = shape.Faces is null ? null : ColliderQuality.Oracle(shape.Faces, positions);
        var answers = rows.Select(row => Ask(row, positions, oracle)).ToArray();
        if (oracle is not null)
        {
            foreach (var (row, answer) in rows.Zip(answers))
            {
                Check(shape, row, answer.Distances, oracle);
            }
        }

        var times = Times(rows, positions, [.. answers.Select(answer => TimedPositions(answer.FaceTests + answer.BoundTests))]);
        for (var i = 0; i < rows.Count; i++)
        {
            var (row, answer) = (rows[i], answers[i]);
            AnswerErrors? errors = oracle is null ? null : AnswerErrors.Of(answer.Distances, oracle, shape.Size);
            table.Add(
                shape.Name, shape.Faces?.FaceCount, kind, row.Name, row.Knob, row.Value, Math.Round(times[i], 1), answer.FaceTests,
                answer.BoundTests,
                errors?.Largest, errors?.Mean, errors?.LargestRelative, errors?.MeanRelative, errors?.MissedPercent, row.Bytes,
                Math.Round(row.BuildMilliseconds, 2));
        }
    }

    /// <summary>All positions; a collider that is the oracle is asked for its costs only, with one.</summary>
    private (double[] Distances, double FaceTests, double BoundTests) Ask(FrontRow row, Vector[] positions, double[]? oracle)
    {
        _record.Reset();
        var asked = row.Collider is SimpleCollider ? positions[..1] : positions;
        var distances = asked.Select(position =>
            row.Collider.TryFindClosest(position, double.PositiveInfinity, _record, out var closest, row.Epsilon)
            ? closest.Distance
            : double.PositiveInfinity).ToArray();
        return (asked.Length < positions.Length ? oracle! : distances, (double)_record.FaceTests / asked.Length,
            (double)_record.BoundTests / asked.Length);
    }

    private static void Check(FrontShape shape, FrontRow row, double[] distances, double[] oracle)
    {
        var rounding = AnswerErrors.Rounding * shape.Size;
        for (var i = 0; i < oracle.Length; i++)
        {
            var most = row.Collider.IsExact ? ((1 + row.Epsilon) * oracle[i]) + rounding : double.PositiveInfinity;
            if (!(distances[i] >= oracle[i] - rounding && distances[i] <= most))
            {
                throw new InvalidDataException(FormattableString.Invariant(
                    $"{shape.Name}, {row.Name} {row.Knob} {row.Value}, position {i}: found {distances[i]:R} where every face gives {oracle[i]:R}"));
            }
        }
    }

    private int TimedPositions(double tests) =>
        Math.Clamp((int)(TestsOfRound / Math.Max(tests, 1)), Math.Min(FewestTimed, queries), queries);

    /// <summary>Nanoseconds a query.</summary>
    private double[] Times(IReadOnlyList<FrontRow> rows, Vector[] positions, int[] counts)
    {
        var best = new double[rows.Count];
        Array.Fill(best, double.PositiveInfinity);
        var watch = Stopwatch.StartNew();
        for (var round = 0; round < rounds || watch.Elapsed < WarmUp; round++)
        {
            for (var i = 0; i < best.Length; i++)
            {
                // Once more than is timed: else whoever is first with a structure of megabytes brings it into the caches for the others.
                Time(rows[i], positions.AsSpan(0, counts[i]));
                best[i] = Math.Min(best[i], Time(rows[i], positions.AsSpan(0, counts[i])));
            }
        }

        return best;
    }

    private double Time(FrontRow row, ReadOnlySpan<Vector> positions)
    {
        var start = Stopwatch.GetTimestamp();
        foreach (var position in positions)
        {
            row.Collider.TryFindClosest(position, double.PositiveInfinity, _record, out _, row.Epsilon);
        }

        return Stopwatch.GetElapsedTime(start).TotalNanoseconds / positions.Length;
    }
}
