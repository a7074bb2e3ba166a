using System.Buffers.Binary;

namespace FractalEngine.Core.Images;

/// <summary>Writes the signature and chunks with their CRCs (PNG, third edition, §5).</summary>
/// <param name="stream">Where to; left open.</param>
internal sealed class PngChunkWriter(Stream stream)
{
    /// <summary>Writes the signature of the file.</summary>
    public void WriteSignature() => stream.Write(PngChunk.Signature);

    /// <summary>Writes one chunk with its CRC.</summary>
    /// <param name="type">Its type, the first letter highest.</param>
    /// <param name="data">Its contents.</param>
    public void Write(uint type, ReadOnlySpan<byte> data)
    {
        Span<byte> head = stackalloc byte[8];
        BinaryPrimitives.WriteInt32BigEndian(head, data.Length);
        BinaryPrimitives.WriteUInt32BigEndian(head[4..], type);
        Span<byte> crc = stackalloc byte[4];
        BinaryPrimitives.WriteUInt32BigEndian(crc, Crc32.Append(Crc32.Append(0, head[4..]), data));
        stream.Write(head);
        stream.Write(data);
        stream.Write(crc);
    }
}
