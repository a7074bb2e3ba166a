namespace FractalEngine.App;

/// <summary>Passes on what is written, until a signal has arrived.</summary>
/// <param name="target">Receives the bytes; left open.</param>
/// <param name="interruption">Polled before each write.</param>
internal sealed class InterruptibleStream(Stream target, InterruptSignal interruption) : Stream
{
    /// <inheritdoc/>
    public override bool CanRead => false;

    /// <inheritdoc/>
    public override bool CanSeek => false;

    /// <inheritdoc/>
    public override bool CanWrite => true;

    /// <inheritdoc/>
    public override long Length => throw new NotSupportedException();

    /// <inheritdoc/>
    public override long Position
    {
        get => throw new NotSupportedException();
        set => throw new NotSupportedException();
    }

    /// <inheritdoc/>
    public override void Flush() => target.Flush();

    /// <inheritdoc/>
    /// <exception cref="OperationCanceledException">A signal has arrived.</exception>
    public override void Write(byte[] buffer, int offset, int count) => Write(buffer.AsSpan(offset, count));

    /// <inheritdoc/>
    /// <exception cref="OperationCanceledException">A signal has arrived.</exception>
    public override void Write(ReadOnlySpan<byte> buffer)
    {
        interruption.ThrowIfRequested();
        target.Write(buffer);
    }

    /// <inheritdoc/>
    public override int Read(byte[] buffer, int offset, int count) => throw new NotSupportedException();

    /// <inheritdoc/>
    public override long Seek(long offset, SeekOrigin origin) => throw new NotSupportedException();

    /// <inheritdoc/>
    public override void SetLength(long value) => throw new NotSupportedException();
}
