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
    public static long Measure(Action run)
    {
        var before = GC.GetAllocatedBytesForCurrentThread();
        run();
        return GC.GetAllocatedBytesForCurrentThread() - before;
    }
}
