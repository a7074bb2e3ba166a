using System.Globalization;
using System.Runtime.InteropServices;
using FractalEngine.Core.Files;

namespace FractalEngine.App.Shell;

/// <summary>
/// Receives SIGINT, SIGTERM and SIGHUP, so that unfinished work can be undone before the program ends. A second signal ends the program
/// at once, as does SIGINT or SIGTERM while there is no such work.
/// </summary>
internal sealed class InterruptSignal : IDisposable
{
    // Work between two polls takes milliseconds. Where it takes longer something is wrong, and the user is not made to wait.
    private static readonly TimeSpan AcknowledgeTimeout = TimeSpan.FromSeconds(3);

    private static readonly TimeSpan MessageTimeout = TimeSpan.FromSeconds(0.5);

    private static PosixSignalRegistration[] _processRegistrations = [];
    private static int _liveCount;

    private readonly PosixSignalRegistration[] _registrations;
    private readonly ManualResetEventSlim _acknowledged = new();
    private readonly CancellationTokenSource _cancellation = new();
    private volatile bool _isRequested;

    /// <summary>Registers the signal handlers until the object is disposed.</summary>
    public InterruptSignal()
    {
        Interlocked.Increment(ref _liveCount);
        _registrations =
        [
            .. Register(OnSignal),
            .. IgnoresHangup() ? [] : (PosixSignalRegistration[])[PosixSignalRegistration.Create(PosixSignal.SIGHUP, OnSignal)],
        ];
    }

    /// <summary>Lets SIGINT and SIGTERM end the process at once, without unfinished files, while no object takes care of them.</summary>
    public static void EndProcessOtherwise() => _processRegistrations = [.. _processRegistrations, .. Register(EndProcess)];

    /// <summary>Cancelled when a signal arrives, which the work then acknowledges.</summary>
    public CancellationToken Token => _cancellation.Token;

    /// <summary>Says that the work has stopped, so that the program ends in its own way.</summary>
    public void Acknowledge() => _acknowledged.Set();

    /// <summary>Throws if a signal has arrived, and acknowledges it.</summary>
    /// <exception cref="OperationCanceledException">A signal has arrived.</exception>
    public void ThrowIfRequested()
    {
        if (_isRequested)
        {
            _acknowledged.Set();
            throw new OperationCanceledException("interrupted");
        }
    }

    public void Dispose()
    {
        Array.ForEach(_registrations, static registration => registration.Dispose());
        _cancellation.Dispose();
        Interlocked.Decrement(ref _liveCount);
    }

    private static PosixSignalRegistration[] Register(Action<PosixSignalContext> handler) =>
        [PosixSignalRegistration.Create(PosixSignal.SIGINT, handler), PosixSignalRegistration.Create(PosixSignal.SIGTERM, handler)];

    // Runs on a thread of the runtime. Cancelling the signal keeps the process alive for the work to be undone.
    private void OnSignal(PosixSignalContext context)
    {
        var isFirst = !_isRequested;
        // First, since work that polls may dispose this object at once.
        _cancellation.Cancel();
        _isRequested = true;
        context.Cancel = isFirst && _acknowledged.Wait(AcknowledgeTimeout);
        if (!context.Cancel)
        {
            EndProcess();
        }
    }

    private static void EndProcess(PosixSignalContext context)
    {
        // What took the signal already may be disposed by now, and ends the program in its own way.
        context.Cancel |= Volatile.Read(ref _liveCount) > 0;
        if (!context.Cancel)
        {
            EndProcess();
        }
    }

    /// <summary>Deletes unfinished files and ends the process.</summary>
    private static void EndProcess()
    {
        AtomicFile.DeleteUnfinished();
        // What holds the stream may wait for ever.
        Task.Run(static () => Console.Error.WriteLine("error: interrupted")).Wait(MessageTimeout);
        if (OperatingSystem.IsLinux() || OperatingSystem.IsMacOS())
        {
            // Without the handlers that libraries have registered for the exit: those of OpenGL free what the window's thread still uses.
            ExitWithoutHandlers(ExitCode.Interrupted);
        }

        Environment.Exit(ExitCode.Interrupted);
    }

    [DllImport("libc", EntryPoint = "_exit")]
    private static extern void ExitWithoutHandlers(int exitCode);

    /// <summary>True where the program was started to outlive its terminal, as <c>nohup</c> does. Known on Linux only.</summary>
    private static bool IgnoresHangup()
    {
        const string prefix = "SigIgn:";
        const string status = "/proc/self/status";
        return File.Exists(status)
            && File.ReadLines(status).FirstOrDefault(line => line.StartsWith(prefix, StringComparison.Ordinal)) is { } line
            && ulong.TryParse(line[prefix.Length..], NumberStyles.HexNumber, CultureInfo.InvariantCulture, out var mask)
            && (mask & 1) != 0;
    }
}
