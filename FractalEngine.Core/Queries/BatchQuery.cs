using System.Collections.Immutable;
using System.Runtime.ExceptionServices;
using System.Runtime.InteropServices;

namespace FractalEngine.Core.Queries;

/// <summary>Asks the same question many times at once, on all cores: any question of a collider or a caster of rays.</summary>
/// <example>
/// <code>
/// var hits = BatchQuery.Run(positions, (position, context) => collider.FindClosest(position, context));
/// </code>
/// </example>
public static class BatchQuery
{
    // Enough for a thread to be worth waking: from some microseconds to some milliseconds.
    private const int CountPerTask = 256;

    /// <summary>Asks a question of each of many inputs.</summary>
    /// <typeparam name="TInput">What differs: a position, a ray, a box, a placement.</typeparam>
    /// <typeparam name="TAnswer">What one question is answered with.</typeparam>
    /// <param name="inputs">In the frame of the query, as where one is asked alone.</param>
    /// <param name="ask">Asks the question of one input, with the context of its thread.</param>
    /// <param name="context">Receives the sum of the costs; null where they don't matter.</param>
    /// <param name="threads">The most threads to use; null for one a core.</param>
    /// <returns>One answer for each input, in the same order and the same on any number of threads.</returns>
    /// <exception cref="ArgumentOutOfRangeException">There are no threads.</exception>
    /// <remarks>
    /// What a question throws alone is thrown here too, on the thread of the caller; of several errors any one. Beside the answers,
    /// memory is taken for each thread only.
    /// </remarks>
    public static ImmutableArray<TAnswer> Run<TInput, TAnswer>(
        IReadOnlyList<TInput> inputs, Func<TInput, QueryContext, TAnswer> ask, QueryContext? context = null, int? threads = null)
    {
        ArgumentNullException.ThrowIfNull(inputs);
        ArgumentNullException.ThrowIfNull(ask);
        ArgumentOutOfRangeException.ThrowIfNegativeOrZero(threads ?? 1, nameof(threads));
        var answers = new TAnswer[inputs.Count];
        var totalsLock = new Lock();
        try
        {
            Parallel.For(
                0,
                (answers.Length + CountPerTask - 1) / CountPerTask,
                new ParallelOptions { MaxDegreeOfParallelism = threads ?? -1 },
                static () => new QueryContext(),
                (task, _, threadContext) =>
                {
                    var end = Math.Min(answers.Length, (task + 1) * CountPerTask);
                    for (var i = task * CountPerTask; i < end; i++)
                    {
                        answers[i] = ask(inputs[i], threadContext);
                    }

                    return threadContext;
                },
                threadContext =>
                {
                    lock (totalsLock)
                    {
                        context?.Statistics.Add(threadContext.Statistics);
                    }
                });
        }
        catch (AggregateException exception)
        {
            ExceptionDispatchInfo.Throw(exception.InnerExceptions[0]);
        }

        return ImmutableCollectionsMarshal.AsImmutableArray(answers);
    }
}
