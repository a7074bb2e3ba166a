namespace FractalEngine.Core.Images;

/// <summary>The data of consecutive <c>IDAT</c> chunks as one stream, whose chunks are read when they are asked for.</summary>
/// <param name="chunks">At the first of these chunks; afterwards at the first chunk behind them.</param>
internal sealed class PngDataStream(PngChunkReader chunks) : Stream
{
    // What CheckFormat read, to be read again.
    private readonly byte[] _head = new byte[2];
    private int _headStart;
    private int _headEnd;

    /// <inheritdoc/>
    public override bool CanRead => true;

    /// <inheritdoc/>
    public override bool CanSeek => false;

    /// <inheritdoc/>
    public override bool CanWrite => false;

    /// <inheritdoc/>
    public override long Length => throw new NotSupportedException();

    /// <inheritdoc/>
    public override long Position
    {
        get => throw new NotSupportedException();
        set => throw new NotSupportedException();
    }

    /// <summary>
    /// Checks the two bytes that zlib's format begins with (RFC 1950, §2.2). The framework does so too. But where a dictionary is needed,
    /// which PNG does not allow, its exception differs from one of the file system by its words only.
    /// </summary>
    /// <exception cref="PngException">The data is not what PNG allows, or a chunk is damaged.</exception>
    public void CheckFormat()
    {
        _headEnd = this.ReadAtLeast(_head, _head.Length, throwOnEndOfStream: false);
        if (_headEnd < _head.Length)
        {
            return;
        }

        const int Deflate = 8;
        const int MaxWindow = 7;
        var method = _head[0];
        var flags = _head[1];
        if ((method & 0xF) != Deflate || method >> 4 > MaxWindow || ((method << 8) | flags) % 31 != 0 || (flags & 0x20) != 0)
        {
            throw new PngException(
                chunks.Position - _head.Length, $"the compressed pixels begin with 0x{method:X2}{flags:X2}, which PNG does not allow");
        }
    }

    /// <inheritdoc/>
    /// <exception cref="PngException">A chunk is damaged, or the file ends.</exception>
    public override int Read(Span<byte> buffer)
    {
        if (_headStart < _headEnd)
        {
            var count = Math.Min(buffer.Length, _headEnd - _headStart);
            _head.AsSpan(_headStart, count).CopyTo(buffer);
            _headStart += count;
            return count;
        }

        while (chunks.Type == PngChunk.Data)
        {
            if (buffer.IsEmpty || chunks.Remaining > 0)
            {
                return chunks.Read(buffer);
            }

            chunks.Advance();
        }

        return 0;
    }

    /// <inheritdoc/>
    public override int Read(byte[] buffer, int offset, int count) => Read(buffer.AsSpan(offset, count));

    /// <summary>Goes on to the first chunk that is no <c>IDAT</c>. What is skipped is checked by its CRC, but not decompressed.</summary>
    public void SkipRest()
    {
        while (chunks.Type == PngChunk.Data)
        {
            chunks.Advance();
        }
    }

    /// <inheritdoc/>
    public override void Flush()
    {
    }

    /// <inheritdoc/>
    public override long Seek(long offset, SeekOrigin origin) => throw new NotSupportedException();

    /// <inheritdoc/>
    public override void SetLength(long value) => throw new NotSupportedException();

    /// <inheritdoc/>
    public override void Write(byte[] buffer, int offset, int count) => throw new NotSupportedException();
}
