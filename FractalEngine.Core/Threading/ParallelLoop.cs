namespace FractalEngine.Core.Threading;

/// <summary>Runs loops on several threads, and single iterations on the caller's own.</summary>
/// <param name="maxThreads">Maximum number of threads; null for one a core.</param>
internal sealed class ParallelLoop(int? maxThreads)
{
    private readonly ParallelOptions _options = new() { MaxDegreeOfParallelism = maxThreads ?? -1 };

    /// <summary>Calls a function once for each index from 0, in any order.</summary>
    /// <param name="count">Number of calls.</param>
    /// <param name="body">The function; it must allow concurrent calls.</param>
    public void For(int count, Action<int> body)
    {
        if (count == 1)
        {
            body(0);
        }
        else
        {
            Parallel.For(0, count, _options, body);
        }
    }
}
