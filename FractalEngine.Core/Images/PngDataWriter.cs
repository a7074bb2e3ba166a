namespace FractalEngine.Core.Images;

/// <summary>A stream whose bytes become <c>IDAT</c> chunks of at most 64 KiB.</summary>
/// <param name="chunks">Where the chunks go.</param>
internal sealed class PngDataWriter(PngChunkWriter chunks) : Stream
{
    private const int ChunkBytes = 1 << 16;

    private readonly byte[] _data = new byte[ChunkBytes];
    private int _count;

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
    public override void Write(ReadOnlySpan<byte> buffer)
    {
        while (!buffer.IsEmpty)
        {
            var count = Math.Min(buffer.Length, _data.Length - _count);
            buffer[..count].CopyTo(_data.AsSpan(_count));
            _count += count;
            buffer = buffer[count..];
            if (_count == _data.Length)
            {
                WriteChunk();
            }
        }
    }

    /// <inheritdoc/>
    public override void Write(byte[] buffer, int offset, int count) => Write(buffer.AsSpan(offset, count));

    /// <summary>Does nothing: a chunk is written once it is full, the last one by <see cref="WriteRest"/>.</summary>
    public override void Flush()
    {
    }

    /// <summary>Writes what is left as the last chunk.</summary>
    public void WriteRest()
    {
        if (_count > 0)
        {
            WriteChunk();
        }
    }

    /// <inheritdoc/>
    public override int Read(byte[] buffer, int offset, int count) => throw new NotSupportedException();

    /// <inheritdoc/>
    public override long Seek(long offset, SeekOrigin origin) => throw new NotSupportedException();

    /// <inheritdoc/>
    public override void SetLength(long value) => throw new NotSupportedException();

    private void WriteChunk()
    {
        chunks.Write(PngChunk.Data, _data.AsSpan(0, _count));
        _count = 0;
    }
}
