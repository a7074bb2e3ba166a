using FractalEngine.Core.Colliders;
using FractalEngine.Core.Geometry.Triangles;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Queries;

namespace FractalEngine.Core.SceneQueries;

/// <summary>Finds the closest points of many positions at once, on all cores.</summary>
public static class BatchQuery
{
    // Enough for a thread to be worth waking: from some microseconds to some milliseconds.
    private const int PositionsPerTask = 256;

    /// <summary>Finds the point of a shape closest to each position.</summary>
    /// <param name="collider">A collider of any kind; its results do not depend on the number of threads.</param>
    /// <param name="positions">In the shape's frame, scene units, finite.</param>
    /// <param name="maxDistance">Search radius, scene units, not negative; may be infinite.</param>
    /// <param name="epsilon">Allowed relative error, not negative.</param>
    /// <param name="threads">The most threads to use; null for one a core.</param>
    /// <returns>One result for each position, in the same order.</returns>
    /// <exception cref="ArgumentOutOfRangeException">
    /// A position is not finite, the radius or ε is negative or NaN, or there are no threads.
    /// </exception>
    public static BatchResult[] FindClosest(
        Collider collider,
        ReadOnlyMemory<Vector> positions,
        double maxDistance = double.PositiveInfinity,
        double epsilon = 0,
        int? threads = null)
    {
        var results = new BatchResult[positions.Length];
        FindClosest(collider, positions, results, new(), maxDistance, epsilon, threads);
        return results;
    }

    /// <summary>Finds the point of a shape closest to each position, and adds up what that costs.</summary>
    /// <param name="collider">A collider of any kind; its results do not depend on the number of threads.</param>
    /// <param name="positions">In the shape's frame, scene units, finite.</param>
    /// <param name="results">As many as positions; receives the results in the same order.</param>
    /// <param name="context">Receives the sum of the costs. Its instance path is emptied: there is one for each position.</param>
    /// <param name="maxDistance">Search radius, scene units, not negative; may be infinite.</param>
    /// <param name="epsilon">Allowed relative error, not negative.</param>
    /// <param name="threads">The most threads to use; null for one a core.</param>
    /// <exception cref="ArgumentException">There are fewer or more results than positions.</exception>
    /// <exception cref="ArgumentOutOfRangeException">
    /// A position is not finite, the radius or ε is negative or NaN, or there are no threads.
    /// </exception>
    /// <remarks>Allocates for each thread, nothing for a position.</remarks>
    public static void FindClosest(
        Collider collider,
        ReadOnlyMemory<Vector> positions,
        Memory<BatchResult> results,
        QueryContext context,
        double maxDistance = double.PositiveInfinity,
        double epsilon = 0,
        int? threads = null)
    {
        ArgumentNullException.ThrowIfNull(collider);
        ArgumentNullException.ThrowIfNull(context);
        FindClosest(Find, positions, results, context, maxDistance, epsilon, threads);

        bool Find(Vector position, QueryContext threadContext, out ClosestPoint closest, out int objectIndex)
        {
            var isFound = collider.TryFindClosest(position, maxDistance, threadContext, out closest, epsilon);
            objectIndex = isFound ? 0 : -1;
            return isFound;
        }
    }

    /// <summary>Finds the point of a scene closest to each position, and adds up what that costs.</summary>
    /// <param name="scene">All its objects are tested.</param>
    /// <param name="positions">World space, finite.</param>
    /// <param name="results">As many as positions; receives the results in the same order.</param>
    /// <param name="context">Receives the sum of the costs. Its instance path is emptied.</param>
    /// <param name="maxDistance">Search radius, scene units, not negative; may be infinite.</param>
    /// <param name="epsilon">Allowed relative error, not negative.</param>
    /// <param name="threads">The most threads to use; null for one a core.</param>
    /// <exception cref="ArgumentException">There are fewer or more results than positions.</exception>
    /// <exception cref="ArgumentOutOfRangeException">
    /// A position is not finite, the radius or ε is negative or NaN, or there are no threads.
    /// </exception>
    public static void FindClosest(
        SceneCollider scene,
        ReadOnlyMemory<Vector> positions,
        Memory<BatchResult> results,
        QueryContext context,
        double maxDistance = double.PositiveInfinity,
        double epsilon = 0,
        int? threads = null)
    {
        ArgumentNullException.ThrowIfNull(scene);
        ArgumentNullException.ThrowIfNull(context);
        FindClosest(Find, positions, results, context, maxDistance, epsilon, threads);

        bool Find(Vector position, QueryContext threadContext, out ClosestPoint closest, out int objectIndex) =>
            scene.TryFindClosest(position, maxDistance, threadContext, out closest, out objectIndex, epsilon: epsilon);
    }

    private delegate bool Query(Vector position, QueryContext context, out ClosestPoint closest, out int objectIndex);

    private static void FindClosest(
        Query query, ReadOnlyMemory<Vector> positions, Memory<BatchResult> results, QueryContext context, double maxDistance,
        double epsilon, int? threads)
    {
        ThrowIfInvalid(positions.Span, results.Length, maxDistance, epsilon, threads);
        context.ClearPath();
        QueryTasks.Run(positions.Length, PositionsPerTask, threads, context, (first, end, threadContext) => RunQueries(
            query, positions.Span[first..end], results.Span[first..end], threadContext));
    }

    private static void ThrowIfInvalid(ReadOnlySpan<Vector> positions, int results, double maxDistance, double epsilon, int? threads)
    {
        if (results != positions.Length)
        {
            throw new ArgumentException($"expected {positions.Length} results, one for each position", nameof(results));
        }

        // Before any thread begins, so that the error is the caller's own and names the first.
        for (var i = 0; i < positions.Length; i++)
        {
            if (!positions[i].IsFinite())
            {
                throw new ArgumentOutOfRangeException(nameof(positions), positions[i], $"expected finite coordinates at index {i}");
            }
        }

        Collider.ThrowIfInvalid(maxDistance, epsilon);
        QueryTasks.ThrowIfNoThreads(threads);
    }

    private static void RunQueries(Query query, ReadOnlySpan<Vector> positions, Span<BatchResult> results, QueryContext context)
    {
        for (var i = 0; i < positions.Length; i++)
        {
            var (faceTests, boundTests) = (context.Statistics.FaceTests, context.Statistics.BoundTests);
            var isFound = query(positions[i], context, out var closest, out var objectIndex);
            results[i] = new(
                isFound, closest, context.Statistics.FaceTests - faceTests, context.Statistics.BoundTests - boundTests, objectIndex);
        }
    }
}
