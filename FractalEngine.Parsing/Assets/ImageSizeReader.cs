using System.Buffers.Binary;
using FractalEngine.Core.Images;

namespace FractalEngine.Parsing.Assets;

/// <summary>Reads the size of an image from the header of its file, so that it is known before any memory is allocated.</summary>
internal static class ImageSizeReader
{
    // Bytes that hold the size in a PNG, BMP or TGA file.
    private const int HeaderBytes = 26;

    /// <summary>Returns width and height in pixels of a PNG, JPEG, BMP or TGA image; null for any other file.</summary>
    /// <param name="stream">Seekable stream at its beginning.</param>
    /// <param name="isTga">Whether the name of the file ends in <c>.tga</c>, because that format has no signature.</param>
    public static (long Width, long Height)? Read(Stream stream, bool isTga)
    {
        Span<byte> header = stackalloc byte[HeaderBytes];
        header = header[..stream.ReadAtLeast(header, HeaderBytes, throwOnEndOfStream: false)];
        return header switch
        {
            _ when PngReader.IsPng(header) => ReadPngSize(header),
            [0xFF, 0xD8, ..] => ReadJpegSize(stream),
            [(byte)'B', (byte)'M', ..] => ReadBmpSize(header),
            _ when isTga => ReadTgaSize(header),
            _ => null,
        };
    }

    private static (long Width, long Height)? ReadPngSize(ReadOnlySpan<byte> header) => header.Length < 24
        ? null
        : (BinaryPrimitives.ReadUInt32BigEndian(header[16..]), BinaryPrimitives.ReadUInt32BigEndian(header[20..]));

    private static (long Width, long Height)? ReadBmpSize(ReadOnlySpan<byte> header)
    {
        if (header.Length < HeaderBytes)
        {
            return null;
        }

        // The oldest kind of header has 12 bytes and 16-bit numbers.
        if (BinaryPrimitives.ReadUInt32LittleEndian(header[14..]) == 12)
        {
            return (BinaryPrimitives.ReadUInt16LittleEndian(header[18..]), BinaryPrimitives.ReadUInt16LittleEndian(header[20..]));
        }

        // A negative height means that the rows run from top to bottom.
        var width = Math.Abs((long)BinaryPrimitives.ReadInt32LittleEndian(header[18..]));
        var height = Math.Abs((long)BinaryPrimitives.ReadInt32LittleEndian(header[22..]));
        return (width, height);
    }

    /// <summary>Reads the size of a TGA image with one of its six pixel types: 1 to 3, and 9 to 11 for run-length encoding.</summary>
    private static (long Width, long Height)? ReadTgaSize(ReadOnlySpan<byte> header) =>
        header.Length < 18 || header[2] is not (1 or 2 or 3 or 9 or 10 or 11)
            ? null
            : (BinaryPrimitives.ReadUInt16LittleEndian(header[12..]), BinaryPrimitives.ReadUInt16LittleEndian(header[14..]));

    /// <summary>Reads the size of a JPEG image from its first frame segment (ITU-T T.81, §B.2).</summary>
    private static (long Width, long Height)? ReadJpegSize(Stream stream)
    {
        Span<byte> segment = stackalloc byte[9];
        for (var position = 2L; ;)
        {
            stream.Position = position;
            if (stream.ReadAtLeast(segment, segment.Length, throwOnEndOfStream: false) < segment.Length || segment[0] != 0xFF)
            {
                return null;
            }

            switch (segment[1])
            {
                case 0xFF:
                    // Fill bytes may precede a marker.
                    position++;
                    break;
                case >= 0xC0 and <= 0xCF and not (0xC4 or 0xC8 or 0xCC):
                    return (BinaryPrimitives.ReadUInt16BigEndian(segment[7..]), BinaryPrimitives.ReadUInt16BigEndian(segment[5..]));
                default:
                    position += 2 + BinaryPrimitives.ReadUInt16BigEndian(segment[2..]);
                    break;
            }
        }
    }
}
