using System.Runtime.InteropServices;

namespace FractalEngine.App.Shell;

/// <summary>What the system lets the process use: how many files it opens, and how large a file becomes.</summary>
internal static class ProcessLimits
{
    // The runtime keeps each of its libraries open: 80 suffice for an image. With fewer it misses libraries, and ends in a stack trace.
    private const ulong MinOpenFiles = 96;

    // From <sys/resource.h> of Linux.
    private const int OpenFiles = 7;

    // SIGXFSZ of <signal.h>, with the same value on Linux and macOS.
    private const PosixSignal FileTooLarge = (PosixSignal)25;

    private static PosixSignalRegistration? _registration;

    /// <summary>Lets a file beyond the limit of the system be an error of the write, instead of the end of the process.</summary>
    /// <returns>Why the program can't run; null where it can.</returns>
    public static string? Apply()
    {
        if (OperatingSystem.IsLinux() || OperatingSystem.IsMacOS())
        {
            _registration ??= PosixSignalRegistration.Create(FileTooLarge, static context => context.Cancel = true);
        }

        // The first is the limit, and the second how far the process may raise it.
        var limits = new ulong[2];
        return OperatingSystem.IsLinux() && ReadLimits(OpenFiles, limits) == 0 && limits[0] < MinOpenFiles
            ? FormattableString.Invariant($"the system lets the program open {limits[0]} files, and it needs {MinOpenFiles} (ulimit -n)")
            : null;
    }

    [DllImport("libc", EntryPoint = "getrlimit")]
    private static extern int ReadLimits(int resource, ulong[] limits);
}
