using Xunit.Sdk;

namespace FractalEngine.Tests.Support;

/// <summary>
/// Limits the memory that the calling thread allocates. Unlike time it is the same on every run, and it tells when something is expanded,
/// or copied again and again, that must not be.
/// </summary>
internal static class Allocation
{
    /// <summary>Runs something on this thread, and fails if it has allocated more bytes than the limit.</summary>
    public static T RunWithin<T>(long limitBytes, Func<T> run)
    {
        var before = GC.GetAllocatedBytesForCurrentThread();
        var result = run();
        var bytes = GC.GetAllocatedBytesForCurrentThread() - before;
        return bytes <= limitBytes
            ? result
            : throw new XunitException(FormattableString.Invariant($"allocated {bytes} bytes, more than {limitBytes}"));
    }

    /// <summary>Runs something on this thread, and returns the number of bytes that it has allocated there.</summary>
    /// <remarks>
    /// The least of five runs, each of which does the same: a collection that another test causes may count what is left of this thread's
    /// allocation context, but nothing counts less than is allocated.
    /// </remarks>
    public static long Measure(Action run) => Measure(1, () => _ => run());

    /// <summary>Makes steps on this thread, and returns the number of bytes that it has allocated there.</summary>
    /// <param name="count">Number of steps.</param>
    /// <param name="prepare">Makes what does the step of an index, the same each time; what that allocates does not count.</param>
    public static long Measure(int count, Func<Action<int>> prepare) =>
        Least(static () => GC.GetAllocatedBytesForCurrentThread(), count, prepare);

    /// <summary>Makes steps, and returns the number of bytes that all threads of the process have allocated meanwhile.</summary>
    /// <remarks>
    /// The sum of the least of each step in five runs: the test host and the runtime allocate now and then. Other tests do so all the time,
    /// and so this is for short steps of those that run alone, see <see cref="TimedTests"/>.
    /// </remarks>
    /// <inheritdoc cref="Measure(int, Func{Action{int}})"/>
    public static long MeasureAllThreads(int count, Func<Action<int>> prepare) =>
        Least(static () => GC.GetTotalAllocatedBytes(precise: true), count, prepare);

    private static long Least(Func<long> countBytes, int count, Func<Action<int>> prepare)
    {
        var least = new long[count];
        Array.Fill(least, long.MaxValue);
        for (var attempt = 0; attempt < 5 && least.Any(static bytes => bytes > 0); attempt++)
        {
            var step = prepare();
            for (var i = 0; i < count; i++)
            {
                var before = countBytes();
                step(i);
                least[i] = Math.Min(least[i], countBytes() - before);
            }
        }

        return least.Sum();
    }
}
