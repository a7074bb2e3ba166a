using System.Runtime.ExceptionServices;

namespace FractalEngine.Core.Queries;

/// <summary>Runs many queries on several threads, each with a context of its own.</summary>
internal static class QueryTasks
{
    /// <summary>Runs queries in runs of consecutive ones.</summary>
    /// <param name="count">Number of queries.</param>
    /// <param name="countPerTask">Queries of a run: enough for a thread to be worth waking.</param>
    /// <param name="threads">The most threads to use; null for one a core.</param>
    /// <param name="totals">Receives the sum of the costs.</param>
    /// <param name="run">Runs the queries from the first index to before the second.</param>
    /// <exception cref="ArgumentOutOfRangeException">There are no threads.</exception>
    /// <remarks>The error of a query is thrown as it is, on whatever thread it ran.</remarks>
    public static void Run(int count, int countPerTask, int? threads, QueryContext totals, Action<int, int, QueryContext> run)
    {
        ThrowIfNoThreads(threads);
        var totalsLock = new Lock();
        try
        {
            Parallel.For(
                0,
                (count + countPerTask - 1) / countPerTask,
                new ParallelOptions { MaxDegreeOfParallelism = threads ?? -1 },
                static () => new QueryContext(),
                (task, _, context) =>
                {
                    run(task * countPerTask, Math.Min(count, (task + 1) * countPerTask), context);
                    return context;
                },
                context =>
                {
                    lock (totalsLock)
                    {
                        totals.Statistics.Add(context.Statistics);
                    }
                });
        }
        catch (AggregateException exception)
        {
            ExceptionDispatchInfo.Throw(exception.InnerExceptions[0]);
        }
    }

    /// <summary>Checks a number of threads; null stands for one a core.</summary>
    public static void ThrowIfNoThreads(int? threads)
    {
        if (threads is { } number)
        {
            ArgumentOutOfRangeException.ThrowIfNegativeOrZero(number, nameof(threads));
        }
    }
}
