using System.Buffers.Binary;
using System.IO.Compression;
using FractalEngine.Core.Images;

namespace FractalEngine.Parsing.Text;

/// <summary>Decompresses files that end in <c>.gz</c>.</summary>
internal static class CompressedFile
{
    private const int BufferSize = 1 << 16;

    // Header and trailer, which even an empty file has.
    private const int MinLength = 18;
    private const int TrailerLength = 8;

    // The deflate format compresses no further: a trailer that says more is not one.
    private const int MaxCompressionRatio = 1032;

    /// <summary>Decompresses a whole file into memory.</summary>
    /// <param name="stream">The compressed file.</param>
    /// <param name="fileName">Name of the file in messages.</param>
    /// <param name="maxBytes">
    /// Limit on the decompressed bytes; no more of them are ever held. A file that says itself that it has more is refused at once.
    /// </param>
    /// <exception cref="SourceException">The file is damaged, can't be read, or has more bytes.</exception>
    public static MemoryStream Decompress(FileStream stream, string fileName, long maxBytes) => SourceText.Access(fileName, () =>
    {
        try
        {
            return Decompress(stream, maxBytes)
                ?? throw new SourceException(fileName, $"the file has more than the limit of {maxBytes} bytes when decompressed",
                    isLimitExceeded: true);
        }
        catch (InvalidDataException)
        {
            throw new SourceException(fileName, "the file is damaged or not compressed by gzip");
        }
    });

    /// <summary>Returns null beyond the limit.</summary>
    private static MemoryStream? Decompress(FileStream stream, long maxBytes)
    {
        if (stream.Length < MinLength)
        {
            throw new InvalidDataException();
        }

        var (_, size) = ReadTrailer(stream);
        if (size > MaxCompressionRatio * stream.Length)
        {
            throw new InvalidDataException();
        }

        if (size > maxBytes)
        {
            return null;
        }

        using var decompressor = new GZipStream(stream, CompressionMode.Decompress, leaveOpen: true);
        // The buffer has the size that the file states, since a stream that grows holds up to three times its contents.
        var contents = new MemoryStream((int)Math.Min(size, Array.MaxLength));
        var buffer = new byte[BufferSize];
        int count;
        while ((count = decompressor.Read(buffer)) > 0)
        {
            if (contents.Length + count > maxBytes)
            {
                return null;
            }

            contents.Write(buffer, 0, count);
        }

        RequireWhole(stream, contents.GetBuffer().AsSpan(0, (int)contents.Length));
        contents.Position = 0;
        return contents;
    }

    /// <summary>
    /// Requires the file to end with a trailer: the checksum and size of what its last member holds. The framework checks the members that
    /// are whole, but takes the end of the file for the end of a member.
    /// </summary>
    private static void RequireWhole(FileStream stream, ReadOnlySpan<byte> contents)
    {
        var (checksum, size) = ReadTrailer(stream);
        if (size > contents.Length || Crc32.Append(0, contents[^(int)size..]) != checksum)
        {
            throw new InvalidDataException();
        }
    }

    /// <summary>Reads the checksum and the size of the last member, and leaves the stream at its beginning.</summary>
    private static (uint Checksum, uint Size) ReadTrailer(FileStream stream)
    {
        Span<byte> trailer = stackalloc byte[TrailerLength];
        stream.Position = stream.Length - TrailerLength;
        stream.ReadExactly(trailer);
        stream.Position = 0;
        return (BinaryPrimitives.ReadUInt32LittleEndian(trailer), BinaryPrimitives.ReadUInt32LittleEndian(trailer[sizeof(uint)..]));
    }
}
