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

    /// <summary>Ends a command by a signal once it writes a file.</summary>
    /// <param name="folder">Where it runs, and writes.</param>
    /// <param name="signal">Name without SIG, such as "TERM".</param>
    /// <param name="arguments">The command, which would take long.</param>
    /// <returns>Its exit code, and what it wrote to the standard error.</returns>
    public static (int ExitCode, string Error) EndWhileWriting(TemporaryFolder folder, string signal, params string[] arguments)
    {
        Require(signal);
        using var process = AppProcess.Start(folder.Path, [], arguments);
        try
        {
            Polling.WaitUntil(() => Directory.GetFiles(folder.Path, "*.tmp").Length > 0, "output file");
            Send(process, signal);
            Assert.True(process.WaitForExit(Polling.Deadline), "the process does not end");
        }
        finally
        {
            process.Kill();
        }

        return (process.ExitCode, process.StandardError.ReadToEnd().Trim());
    }

    private static bool IgnoresInterrupts() => File.Exists("/proc/self/status")
        && File.ReadLines("/proc/self/status").FirstOrDefault(line => line.StartsWith("SigIgn:", StringComparison.Ordinal)) is { } line
        && (ulong.Parse(line["SigIgn:".Length..].Trim(), NumberStyles.HexNumber, CultureInfo.InvariantCulture) & 2) != 0;
}
