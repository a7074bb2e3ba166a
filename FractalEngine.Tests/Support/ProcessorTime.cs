using System.Globalization;
using Xunit.Sdk;

namespace FractalEngine.Tests.Support;

/// <summary>
/// Processor time of the calling thread. Unlike the time on the clock it does not grow while other tests use the processor, so that a limit
/// holds on a busy machine too. Limits are at least twenty times what a run takes.
/// </summary>
internal static class ProcessorTime
{
    // Linux counts in these for every program, whatever the kernel's own ticks are.
    private const double TicksPerSecond = 100;

    /// <summary>
    /// Processor time that the calling thread has used, to a hundredth of a second. Where the system has no such count, that of the process.
    /// </summary>
    public static TimeSpan OfThread
    {
        get
        {
            const string file = "/proc/thread-self/stat";
            if (!File.Exists(file))
            {
                return Environment.CpuUsage.TotalTime;
            }

            // The name in the second field may hold spaces. Fields 14 and 15 are the times in user and in kernel mode.
            var stat = File.ReadAllText(file);
            var fields = stat[(stat.LastIndexOf(')') + 2)..].Split(' ');
            var ticks = long.Parse(fields[11], CultureInfo.InvariantCulture) + long.Parse(fields[12], CultureInfo.InvariantCulture);
            return TimeSpan.FromSeconds(ticks / TicksPerSecond);
        }
    }

    /// <summary>Runs something on this thread, and fails if it has used more processor time than the limit.</summary>
    public static T RunWithin<T>(double limitSeconds, Func<T> run)
    {
        var before = OfThread;
        var result = run();
        var seconds = (OfThread - before).TotalSeconds;
        if (!(seconds <= limitSeconds))
        {
            throw new XunitException(FormattableString.Invariant($"took {seconds} s of processor time, more than {limitSeconds} s"));
        }

        return result;
    }

    /// <inheritdoc cref="RunWithin{T}(double, Func{T})"/>
    public static void RunWithin(double limitSeconds, Action run) => RunWithin(limitSeconds, () =>
    {
        run();
        return true;
    });
}
