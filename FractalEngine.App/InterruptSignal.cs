using System.Runtime.InteropServices;

namespace FractalEngine.App;

/// <summary>
/// Notes that somebody asks the program to end, so that what it has begun can be taken back first. What does not react, or is asked again,
/// ends at once.
/// </summary>
internal sealed class InterruptSignal : IDisposable
{
    // What is done between two looks takes milliseconds. Where it takes longer something is wrong, and the user is not made to wait.
    private static readonly TimeSpan AcknowledgeTimeout = TimeSpan.FromSeconds(3);

    private readonly PosixSignalRegistration[] _registrations;
    private readonly ManualResetEventSlim _acknowledged = new();
    private volatile bool _isRequested;

    /// <summary>Listens until it is disposed.</summary>
    public InterruptSignal() => _registrations =
        [PosixSignalRegistration.Create(PosixSignal.SIGINT, OnSignal), PosixSignalRegistration.Create(PosixSignal.SIGTERM, OnSignal)];

    /// <summary>Throws when somebody has asked.</summary>
    /// <exception cref="OperationCanceledException">Somebody has.</exception>
    public void ThrowIfRequested()
    {
        if (_isRequested)
        {
            _acknowledged.Set();
            throw new OperationCanceledException("interrupted");
        }
    }

    public void Dispose() => Array.ForEach(_registrations, static registration => registration.Dispose());

    // Runs on a thread of its own.
    private void OnSignal(PosixSignalContext context)
    {
        var isFirst = !_isRequested;
        _isRequested = true;
        context.Cancel = isFirst && _acknowledged.Wait(AcknowledgeTimeout);
    }
}
