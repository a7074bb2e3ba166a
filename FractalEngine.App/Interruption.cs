using System.Runtime.InteropServices;

namespace FractalEngine.App;

/// <summary>Notes that somebody asks the program to end, so that what it has begun can be taken back first. What does not react, or is asked again, ends at once.</summary>
internal sealed class Interruption : IDisposable
{
    // What is done between two looks takes milliseconds. Where it takes longer something is wrong, and the user is not made to wait.
    private static readonly TimeSpan Patience = TimeSpan.FromSeconds(3);

    private readonly PosixSignalRegistration[] _registrations;
    private readonly ManualResetEventSlim _isHeard = new();
    private volatile bool _isAsked;

    /// <summary>Listens until it is disposed.</summary>
    public Interruption() => _registrations =
        [PosixSignalRegistration.Create(PosixSignal.SIGINT, Note), PosixSignalRegistration.Create(PosixSignal.SIGTERM, Note)];

    /// <summary>Throws when somebody has asked.</summary>
    /// <exception cref="OperationCanceledException">Somebody has.</exception>
    public void ThrowIfAsked()
    {
        if (_isAsked)
        {
            _isHeard.Set();
            throw new OperationCanceledException("interrupted");
        }
    }

    public void Dispose() => Array.ForEach(_registrations, static registration => registration.Dispose());

    // Runs on a thread of its own.
    private void Note(PosixSignalContext context)
    {
        var isFirst = !_isAsked;
        _isAsked = true;
        context.Cancel = isFirst && _isHeard.Wait(Patience);
    }
}
