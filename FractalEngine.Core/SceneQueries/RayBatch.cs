using System.Collections.Immutable;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Queries;
using FractalEngine.Core.Rays;

namespace FractalEngine.Core.SceneQueries;

/// <summary>Casts many rays at once, on all cores.</summary>
public static class RayBatch
{
    // Enough for a thread to be worth waking: some hundred microseconds.
    private const int RaysPerTask = 512;

    /// <summary>Finds the nearest face of a scene that each ray hits.</summary>
    /// <param name="scene">All its objects are tested.</param>
    /// <param name="rays">World space.</param>
    /// <param name="context">Receives the sum of the costs; null where they don't matter.</param>
    /// <param name="threads">The most threads to use; null for one a core.</param>
    /// <returns>One result for each ray, in the same order and the same on any number of threads.</returns>
    /// <exception cref="ArgumentException">A ray is not finite, its direction is 0, or there are no threads.</exception>
    /// <exception cref="FractalLimitException">A model can't be prepared, see <see cref="RayCaster.For(Fractal)"/>.</exception>
    public static ImmutableArray<RayResult> FindNearest(
        SceneRayCaster scene, ReadOnlyMemory<Ray> rays, QueryContext? context = null, int? threads = null)
    {
        ArgumentNullException.ThrowIfNull(scene);
        QueryTasks.ThrowIfNoThreads(threads);
        // Before any thread begins, so that the error is the caller's own and names the first.
        foreach (ref readonly var ray in rays.Span)
        {
            RayCaster.CheckedUnitDirection(in ray, 0, double.PositiveInfinity);
        }

        var results = new RayResult[rays.Length];
        QueryTasks.Run(rays.Length, RaysPerTask, threads, context ?? new(), (first, end, threadContext) =>
        {
            for (var i = first; i < end; i++)
            {
                results[i] = scene.TryFindNearest(rays.Span[i], threadContext, out var hit, out var objectIndex)
                    ? new(objectIndex, hit, [.. threadContext.InstancePath])
                    : RayResult.None;
            }
        });
        return [.. results];
    }
}
