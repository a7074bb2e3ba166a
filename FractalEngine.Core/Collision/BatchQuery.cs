using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Collision;

/// <summary>Asks a collider or a scene for many positions at once, on all cores.</summary>
public static class BatchQuery
{
    // Enough for a thread to be worth waking: from some microseconds to some milliseconds.
    private const int PositionsPerTask = 256;

    /// <summary>Finds the nearest point for each position.</summary>
    /// <param name="collider">Any; its answers do not depend on the number of threads.</param>
    /// <param name="positions">In the shape's frame, scene units, finite.</param>
    /// <param name="results">As many as positions; receives the answers in the same order.</param>
    /// <param name="context">Receives the sum of the costs. Its instance path is emptied: there is one for each position.</param>
    /// <param name="maxDistance">As in <see cref="Collider.TryFindClosest"/>.</param>
    /// <param name="epsilon">As in <see cref="Collider.TryFindClosest"/>.</param>
    /// <param name="threads">At most so many; null for one a core.</param>
    /// <exception cref="ArgumentException">There are fewer or more answers than positions.</exception>
    /// <exception cref="ArgumentOutOfRangeException">
    /// A position is not finite, a distance or ε is negative or NaN, or there are no threads.
    /// </exception>
    /// <remarks>Allocates for each thread, nothing for a position.</remarks>
    public static void FindClosest(
        Collider collider,
        ReadOnlyMemory<Vector> positions,
        Memory<BatchResult> results,
        QueryContext context,
        double maxDistance = double.PositiveInfinity,
        double epsilon = 0,
        int? threads = null) => FindClosest(
            (Vector position, QueryContext threadContext, out ClosestPoint closest) => collider.TryFindClosest(position, maxDistance,
            threadContext, out closest, epsilon),
            positions, results, context, maxDistance, epsilon, threads);

    /// <summary>Finds the nearest point of a scene for each position.</summary>
    /// <param name="scene">All objects are looked at.</param>
    /// <param name="positions">World space, finite.</param>
    /// <param name="results">As many as positions; receives the answers in the same order.</param>
    /// <param name="context">Receives the sum of the costs. Its instance path is emptied.</param>
    /// <param name="maxDistance">As in <see cref="Collider.TryFindClosest"/>.</param>
    /// <param name="epsilon">As in <see cref="Collider.TryFindClosest"/>.</param>
    /// <param name="threads">At most so many; null for one a core.</param>
    /// <exception cref="ArgumentException">There are fewer or more answers than positions.</exception>
    /// <exception cref="ArgumentOutOfRangeException">
    /// A position is not finite, a distance or ε is negative or NaN, or there are no threads.
    /// </exception>
    public static void FindClosest(
        SceneCollider scene,
        ReadOnlyMemory<Vector> positions,
        Memory<BatchResult> results,
        QueryContext context,
        double maxDistance = double.PositiveInfinity,
        double epsilon = 0,
        int? threads = null) => FindClosest(
            (Vector position, QueryContext threadContext, out ClosestPoint closest) => scene.TryFindClosest(position, maxDistance,
            threadContext, out closest, out _, epsilon: epsilon),
            positions, results, context, maxDistance, epsilon, threads);

    private delegate bool Query(Vector position, QueryContext context, out ClosestPoint closest);

    private static void FindClosest(
        Query query, ReadOnlyMemory<Vector> positions, Memory<BatchResult> results, QueryContext context, double maxDistance,
        double epsilon, int? threads)
    {
        ThrowIfInvalid(positions.Span, results.Length, maxDistance, epsilon, threads);
        context.ClearPath();
        var taskCount = (positions.Length + PositionsPerTask - 1) / PositionsPerTask;
        var totalsLock = new Lock();
        Parallel.For(
            0,
            taskCount,
            new ParallelOptions { MaxDegreeOfParallelism = threads ?? -1 },
            () => new QueryContext(),
            (task, _, threadContext) =>
            {
                var first = task * PositionsPerTask;
                var count = Math.Min(PositionsPerTask, positions.Length - first);
                RunQueries(query, positions.Span.Slice(first, count), results.Span.Slice(first, count), threadContext);
                return threadContext;
            },
            threadContext =>
            {
                lock (totalsLock)
                {
                    context.FaceTests += threadContext.FaceTests;
                    context.BoundTests += threadContext.BoundTests;
                }
            });
    }

    private static void ThrowIfInvalid(ReadOnlySpan<Vector> positions, int results, double maxDistance, double epsilon, int? threads)
    {
        if (results != positions.Length)
        {
            throw new ArgumentException($"expected {positions.Length} answers, one for each position", nameof(results));
        }

        // Before any thread begins, so that the error is the caller's own and names the first.
        for (var i = 0; i < positions.Length; i++)
        {
            if (!positions[i].IsFinite())
            {
                throw new ArgumentOutOfRangeException(nameof(positions), positions[i], $"expected finite coordinates at index {i}");
            }
        }

        if (!(maxDistance >= 0))
        {
            throw new ArgumentOutOfRangeException(nameof(maxDistance), maxDistance, "expected no negative number");
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

    private static void RunQueries(Query query, ReadOnlySpan<Vector> positions, Span<BatchResult> results, QueryContext context)
    {
        for (var i = 0; i < positions.Length; i++)
        {
            var (faceTests, boundTests) = (context.FaceTests, context.BoundTests);
            var isFound = query(positions[i], context, out var closest);
            results[i] = new(isFound, closest, context.FaceTests - faceTests, context.BoundTests - boundTests);
        }
    }
}
