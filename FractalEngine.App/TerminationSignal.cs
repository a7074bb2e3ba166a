using System.Runtime.InteropServices;
using FractalEngine.Core.Files;

namespace FractalEngine.App;

/// <summary>
/// Ends the program at once on SIGINT and SIGTERM, without unfinished files, unless an <see cref="InterruptSignal"/> takes care of it.
/// </summary>
internal static class TerminationSignal
{
    private static PosixSignalRegistration[] _registrations = [];
    private static int _suspensions;

    /// <summary>Registers the signal handlers for the rest of the process.</summary>
    public static void Install() => _registrations =
    [
        .. _registrations,
        PosixSignalRegistration.Create(PosixSignal.SIGINT, OnSignal),
        PosixSignalRegistration.Create(PosixSignal.SIGTERM, OnSignal),
    ];

    /// <summary>Leaves signals to others until <see cref="Resume"/>.</summary>
    public static void Suspend() => Interlocked.Increment(ref _suspensions);

    /// <summary>Takes signals again, once for each <see cref="Suspend"/>.</summary>
    public static void Resume() => Interlocked.Decrement(ref _suspensions);

    /// <summary>Deletes unfinished files and ends the process.</summary>
    public static void EndProcess()
    {
        AtomicFile.DeleteUnfinished();
        if (OperatingSystem.IsLinux() || OperatingSystem.IsMacOS())
        {
            // Without the handlers that libraries have registered for the exit: those of OpenGL free what the window's thread still uses.
            ExitWithoutHandlers(ExitCode.Interrupted);
        }

        Environment.Exit(ExitCode.Interrupted);
    }

    private static void OnSignal(PosixSignalContext context)
    {
        // What took the signal already may have resumed this since, and now ends the program in its own way.
        if (context.Cancel || Volatile.Read(ref _suspensions) > 0)
        {
            context.Cancel = true;
            return;
        }

        EndProcess();
    }

    [DllImport("libc", EntryPoint = "_exit")]
    [DefaultDllImportSearchPaths(DllImportSearchPath.SafeDirectories)]
    private static extern void ExitWithoutHandlers(int exitCode);
}
