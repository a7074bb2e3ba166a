using System.Buffers.Binary;

namespace FractalEngine.Core.Images;

/// <summary>
/// Reads a PNG file chunk by chunk, forward only, and checks lengths, types and CRCs (PNG, third edition, §5.3). A chunk is never held as a
/// whole, however long it says it is.
/// </summary>
/// <param name="stream">At the beginning of the image; left open.</param>
internal sealed class PngChunkReader(Stream stream)
{
    private const int SkipBytes = 1024;

    private uint _crc;

    /// <summary>Bytes read so far.</summary>
    public long Position { get; private set; }

    /// <summary>The type of the current chunk; 0 before the first one.</summary>
    public uint Type { get; private set; }

    /// <summary>Where the current chunk begins: the offset of its length.</summary>
    public long Start { get; private set; }

    /// <summary>Bytes of the current chunk's data that are still to be read.</summary>
    public int Remaining { get; private set; }

    /// <summary>Reads and checks the file signature.</summary>
    /// <exception cref="PngException">The file is no PNG.</exception>
    public void ReadSignature()
    {
        Span<byte> signature = stackalloc byte[8];
        var count = stream.ReadAtLeast(signature, signature.Length, throwOnEndOfStream: false);
        if (!PngChunk.Signature.SequenceEqual(signature[..count]))
        {
            throw new PngException(0, "no PNG signature");
        }

        Position = signature.Length;
    }

    /// <summary>Skips the rest of the current chunk, checks its CRC, and reads the head of the next one.</summary>
    /// <exception cref="PngException">The CRC does not match, the file ends, or what follows is no chunk.</exception>
    public void Advance()
    {
        Finish();
        Start = Position;
        Span<byte> head = stackalloc byte[8];
        ReadExactly(head, "before the chunk IEND");
        var length = BinaryPrimitives.ReadUInt32BigEndian(head);
        var type = BinaryPrimitives.ReadUInt32BigEndian(head[4..]);
        if (!PngChunk.IsType(type))
        {
            throw new PngException(Start + 4, $"0x{type:X8} is no chunk type");
        }

        if (length > int.MaxValue)
        {
            throw new PngException(Start, $"the length of {PngChunk.Name(type)} is beyond 2147483647 bytes");
        }

        Type = type;
        Remaining = (int)length;
        _crc = Crc32.Append(0, head[4..]);
    }

    /// <summary>Reads some of the current chunk's data.</summary>
    /// <returns>The number of bytes, at least one unless the chunk or <paramref name="buffer"/> is at its end.</returns>
    /// <exception cref="PngException">The file ends within the chunk.</exception>
    public int Read(Span<byte> buffer)
    {
        buffer = buffer[..Math.Min(buffer.Length, Remaining)];
        if (buffer.IsEmpty)
        {
            return 0;
        }

        var count = stream.Read(buffer);
        if (count == 0)
        {
            throw EndOfFile($"within the chunk {PngChunk.Name(Type)}");
        }

        Position += count;
        Remaining -= count;
        _crc = Crc32.Append(_crc, buffer[..count]);
        return count;
    }

    /// <summary>Reads all data of the current chunk and checks its CRC.</summary>
    /// <param name="buffer">As long as the data.</param>
    public void ReadAll(Span<byte> buffer)
    {
        while (!buffer.IsEmpty)
        {
            buffer = buffer[Read(buffer)..];
        }

        Finish();
    }

    /// <summary>Skips the rest of the current chunk and checks its CRC. Does nothing where no chunk is open.</summary>
    /// <exception cref="PngException">The CRC does not match, or the file ends.</exception>
    public void Finish() => Finish(isChecked: true);

    /// <summary>Skips the rest of the current chunk, and its CRC unchecked.</summary>
    /// <exception cref="PngException">The file ends.</exception>
    public void Ignore() => Finish(isChecked: false);

    private void Finish(bool isChecked)
    {
        if (Type == 0)
        {
            return;
        }

        Span<byte> skipped = stackalloc byte[SkipBytes];
        while (Remaining > 0)
        {
            Read(skipped);
        }

        var offset = Position;
        ReadExactly(skipped[..4], $"within the chunk {PngChunk.Name(Type)}");
        if (isChecked && BinaryPrimitives.ReadUInt32BigEndian(skipped) != _crc)
        {
            throw new PngException(offset, $"the CRC of the chunk {PngChunk.Name(Type)} does not match");
        }

        Type = 0;
    }

    private void ReadExactly(Span<byte> buffer, string place)
    {
        var count = stream.ReadAtLeast(buffer, buffer.Length, throwOnEndOfStream: false);
        Position += count;
        if (count < buffer.Length)
        {
            throw EndOfFile(place);
        }
    }

    private PngException EndOfFile(string place) => new(Position, $"the file ends {place}");
}
