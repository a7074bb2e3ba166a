using System.Diagnostics;

namespace FractalEngine.Tests.Support;

/// <summary>Waits for what another thread or program does, where nothing tells when it is done.</summary>
internal static class Polling
{
    /// <summary>
    /// Time after which a wait is a failure: long enough for a loaded machine, as what is waited for comes soon or never.
    /// </summary>
    public static readonly TimeSpan Deadline = TimeSpan.FromSeconds(60);

    // Each look at a window is a process of its own.
    private static readonly TimeSpan Interval = TimeSpan.FromMilliseconds(25);

    /// <summary>Asks again and again until there is an answer.</summary>
    /// <param name="get">Returns null while there is no answer yet.</param>
    /// <param name="description">What is waited for.</param>
    /// <exception cref="TimeoutException">There is no answer at the deadline.</exception>
    public static T WaitFor<T>(Func<T?> get, string description)
        where T : class
    {
        for (var clock = Stopwatch.StartNew(); clock.Elapsed < Deadline; Thread.Sleep(Interval))
        {
            if (get() is { } value)
            {
                return value;
            }
        }

        throw new TimeoutException($"no {description} within {Deadline}");
    }

    /// <summary>Asks again and again until a condition holds.</summary>
    /// <exception cref="TimeoutException">The condition does not hold at the deadline.</exception>
    public static void WaitUntil(Func<bool> condition, string description) => WaitFor(() => condition() ? description : null, description);
}
