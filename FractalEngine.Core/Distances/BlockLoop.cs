using FractalEngine.Core.Threading;

namespace FractalEngine.Core.Distances;

/// <summary>Loops over blocks of elements on several threads. The blocks don't depend on the number of threads.</summary>
/// <param name="maxThreads">Maximum number of threads; null for one a core.</param>
/// <param name="cancellation">Ends a loop after the blocks that have begun.</param>
internal sealed class BlockLoop(int? maxThreads, CancellationToken cancellation)
{
    // Enough to share out evenly, and for sums of all to be cheap.
    private const int MaxBlocks = 1024;

    private readonly ParallelLoop _loop = new(maxThreads);

    /// <summary>Calls a function for each of at most 1024 blocks.</summary>
    /// <typeparam name="T">The result of a block.</typeparam>
    /// <param name="count">Number of elements.</param>
    /// <param name="body">Takes the first element of a block and the one after the last.</param>
    /// <returns>The results in the order of the blocks.</returns>
    /// <exception cref="OperationCanceledException">The loop was cancelled.</exception>
    public T[] For<T>(int count, Func<int, int, T> body)
    {
        var size = (count + MaxBlocks - 1) / MaxBlocks;
        var results = new T[size == 0 ? 0 : (count + size - 1) / size];
        _loop.For(results.Length, block =>
        {
            if (!cancellation.IsCancellationRequested)
            {
                results[block] = body(block * size, Math.Min(count, (block + 1) * size));
            }
        });
        cancellation.ThrowIfCancellationRequested();
        return results;
    }
}
