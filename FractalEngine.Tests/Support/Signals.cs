using System.Diagnostics;
using System.Globalization;

namespace FractalEngine.Tests.Support;

/// <summary>Sends POSIX signals to programs under test.</summary>
internal static class Signals
{
    /// <summary>Skips the test where the system has no signals, or where programs that the tests start do not see this one.</summary>
    /// <param name="signal">Name without SIG, such as "TERM".</param>
    public static void Require(string signal)
    {
        Elsewhere.SkipOnWindows("there are no POSIX signals");
        Elsewhere.SkipIf(signal == "INT" && IgnoresInterrupts(),
            "processes that a shell starts in the background ignore interrupts, and so do their children");
    }

    /// <summary>Sends a signal, and returns when it is sent.</summary>
    /// <param name="process">The process that gets it.</param>
    /// <param name="signal">Name without SIG, such as "TERM".</param>
    public static void Send(Process process, string signal) => Assert.True(TrySend(process, signal));

    /// <summary>Sends a signal as <see cref="Send"/> does, to a process that may have ended; returns whether it got it.</summary>
    public static bool TrySend(Process process, string signal)
    {
        using var kill = Process.Start("kill", ["-s", signal, process.Id.ToString(CultureInfo.InvariantCulture)]);
        kill.WaitForExit();
        return kill.ExitCode == 0;
    }

    private static bool IgnoresInterrupts() => File.Exists("/proc/self/status")
        && File.ReadLines("/proc/self/status").FirstOrDefault(line => line.StartsWith("SigIgn:", StringComparison.Ordinal)) is { } line
        && (ulong.Parse(line["SigIgn:".Length..].Trim(), NumberStyles.HexNumber, CultureInfo.InvariantCulture) & 2) != 0;
}
