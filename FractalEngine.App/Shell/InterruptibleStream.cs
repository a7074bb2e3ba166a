namespace FractalEngine.App.Shell;

/// <summary>Passes on what is written, until that is interrupted.</summary>
/// <param name="target">Receives the bytes; left open.</param>
/// <param name="throwIfInterrupted">Called before each write, and ends it by an <see cref="OperationCanceledException"/>.</param>
internal sealed class InterruptibleStream(Stream target, Action throwIfInterrupted) : WriteOnlyStream
{
    public override void Flush() => target.Flush();

    /// <inheritdoc/>
    /// <exception cref="OperationCanceledException">It was interrupted.</exception>
    public override void Write(ReadOnlySpan<byte> buffer)
    {
        throwIfInterrupted();
        target.Write(buffer);
    }
}
