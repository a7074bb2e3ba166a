using System.Runtime.InteropServices;

namespace FractalEngine.App;

/// <summary>Notes that somebody asks the program to end, so that what it has begun can be taken back first. Who asks twice is obeyed at once.</summary>
internal sealed class Interruption : IDisposable
{
    private readonly PosixSignalRegistration[] _registrations;
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
            throw new OperationCanceledException("interrupted");
        }
    }

    public void Dispose() => Array.ForEach(_registrations, static registration => registration.Dispose());

    private void Note(PosixSignalContext context) => (context.Cancel, _isAsked) = (!_isAsked, true);
}
