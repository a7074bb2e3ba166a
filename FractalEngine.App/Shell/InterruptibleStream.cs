namespace FractalEngine.App.Shell;

/// <summary>Passes on what is written, until a signal has arrived.</summary>
/// <param name="target">Receives the bytes; left open.</param>
/// <param name="interruption">Polled before each write.</param>
internal sealed class InterruptibleStream(Stream target, InterruptSignal interruption) : WriteOnlyStream
{
    public override void Flush() => target.Flush();

    /// <inheritdoc/>
    /// <exception cref="OperationCanceledException">A signal has arrived.</exception>
    public override void Write(ReadOnlySpan<byte> buffer)
    {
        interruption.ThrowIfRequested();
        target.Write(buffer);
    }
}
