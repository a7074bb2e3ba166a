using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Collision;

/// <summary>Asks a collider or a scene for many positions at once, on all cores.</summary>
public static class BatchQuery
{
    // Enough for a thread to be worth waking: from some microseconds to some milliseconds.
    private const int PositionsOfTask = 256;

    /// <summary>Finds the nearest point for each position.</summary>
    /// <param name="collider">Any; its answers do not depend on the number of threads.</param>
    /// <param name="positions">In the shape's frame, scene units, finite.</param>
    /// <param name="answers">As many as positions; receives the answers in the same order.</param>
    /// <param name="record">Receives the sum of the costs. Its instance path is emptied: there is one for each position.</param>
    /// <param name="within">As in <see cref="Collider.TryFindClosest"/>.</param>
    /// <param name="epsilon">As in <see cref="Collider.TryFindClosest"/>.</param>
    /// <param name="threads">At most so many; null for one a core.</param>
    /// <exception cref="ArgumentException">There are fewer or more answers than positions.</exception>
    /// <exception cref="ArgumentOutOfRangeException">A position is not finite, a distance or ε is negative or NaN, or there are no threads.</exception>
    /// <remarks>Allocates for each thread, nothing for a position.</remarks>
    public static void FindClosest(
        Collider collider,
        ReadOnlyMemory<Vector> positions,
        Memory<BatchAnswer> answers,
        QueryRecord record,
        double within = double.PositiveInfinity,
        double epsilon = 0,
        int? threads = null) => FindClosest(
            (Vector position, QueryRecord own, out ClosestPoint closest) => collider.TryFindClosest(position, within, own, out closest, epsilon),
            positions, answers, record, within, epsilon, threads);

    /// <summary>Finds the nearest point of a scene for each position.</summary>
    /// <param name="scene">All objects are looked at.</param>
    /// <param name="positions">World space, finite.</param>
    /// <param name="answers">As many as positions; receives the answers in the same order.</param>
    /// <param name="record">Receives the sum of the costs. Its instance path is emptied.</param>
    /// <param name="within">As in <see cref="Collider.TryFindClosest"/>.</param>
    /// <param name="epsilon">As in <see cref="Collider.TryFindClosest"/>.</param>
    /// <param name="threads">At most so many; null for one a core.</param>
    /// <exception cref="ArgumentException">There are fewer or more answers than positions.</exception>
    /// <exception cref="ArgumentOutOfRangeException">A position is not finite, a distance or ε is negative or NaN, or there are no threads.</exception>
    public static void FindClosest(
        SceneCollider scene,
        ReadOnlyMemory<Vector> positions,
        Memory<BatchAnswer> answers,
        QueryRecord record,
        double within = double.PositiveInfinity,
        double epsilon = 0,
        int? threads = null) => FindClosest(
            (Vector position, QueryRecord own, out ClosestPoint closest) => scene.TryFindClosest(position, within, own, out closest, out _, epsilon: epsilon),
            positions, answers, record, within, epsilon, threads);

    private delegate bool Query(Vector position, QueryRecord record, out ClosestPoint closest);

    private static void FindClosest(
        Query query, ReadOnlyMemory<Vector> positions, Memory<BatchAnswer> answers, QueryRecord record, double within, double epsilon, int? threads)
    {
        Check(positions.Span, answers.Length, within, epsilon, threads);
        record.ClearPath();
        var tasks = (positions.Length + PositionsOfTask - 1) / PositionsOfTask;
        var total = new Lock();
        Parallel.For(
            0,
            tasks,
            new ParallelOptions { MaxDegreeOfParallelism = threads ?? -1 },
            () => new QueryRecord(),
            (task, _, own) =>
            {
                var first = task * PositionsOfTask;
                var count = Math.Min(PositionsOfTask, positions.Length - first);
                Answer(query, positions.Span.Slice(first, count), answers.Span.Slice(first, count), own);
                return own;
            },
            own =>
            {
                lock (total)
                {
                    record.FaceTests += own.FaceTests;
                    record.BoundTests += own.BoundTests;
                }
            });
    }

    private static void Check(ReadOnlySpan<Vector> positions, int answers, double within, double epsilon, int? threads)
    {
        if (answers != positions.Length)
        {
            throw new ArgumentException($"expected {positions.Length} answers, one for each position", nameof(answers));
        }

        // Before any thread begins, so that the error is the caller's own and names the first.
        for (var i = 0; i < positions.Length; i++)
        {
            if (!positions[i].IsFinite())
            {
                throw new ArgumentOutOfRangeException(nameof(positions), positions[i], $"expected finite coordinates at index {i}");
            }
        }

        if (!(within >= 0))
        {
            throw new ArgumentOutOfRangeException(nameof(within), within, "expected no negative number");
        }

        if (!(epsilon >= 0))
        {
            throw new ArgumentOutOfRangeException(nameof(epsilon), epsilon, "expected no negative number");
        }

        if (threads is { } number)
        {
            ArgumentOutOfRangeException.ThrowIfNegativeOrZero(number, nameof(threads));
        }
    }

    private static void Answer(Query query, ReadOnlySpan<Vector> positions, Span<BatchAnswer> answers, QueryRecord record)
    {
        for (var i = 0; i < positions.Length; i++)
        {
            var (faceTests, boundTests) = (record.FaceTests, record.BoundTests);
            var isFound = query(positions[i], record, out var closest);
            answers[i] = new(isFound, closest, record.FaceTests - faceTests, record.BoundTests - boundTests);
        }
    }
}
