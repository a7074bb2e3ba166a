using System.Buffers.Binary;
using FractalEngine.Core.Images;

namespace FractalEngine.Parsing.Assets;

/// <summary>Reads how large a picture is from the head of its file, so that it is known before any memory is asked for.</summary>
internal static class ImageSizeReader
{
    // Far enough for what a PNG, BMP or TGA says of its size.
    private const int HeaderBytes = 26;

    /// <summary>Width and height in pixels of a PNG, JPEG, BMP or TGA file; null where it is none.</summary>
    /// <param name="stream">At its beginning; can seek.</param>
    /// <param name="isTga">Whether the file is called <c>.tga</c>: that format has no mark of its own.</param>
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

    private static (long Width, long Height)? ReadPngSize(ReadOnlySpan<byte> header) => header.Length < 24 ? null
        : (BinaryPrimitives.ReadUInt32BigEndian(header[16..]), BinaryPrimitives.ReadUInt32BigEndian(header[20..]));

    /// <summary>A header of 12 bytes has small numbers; in all others a negative height means that the rows run downwards.</summary>
    private static (long Width, long Height)? ReadBmpSize(ReadOnlySpan<byte> header) => header.Length < HeaderBytes ? null
        : BinaryPrimitives.ReadUInt32LittleEndian(header[14..]) == 12
            ? (BinaryPrimitives.ReadUInt16LittleEndian(header[18..]), BinaryPrimitives.ReadUInt16LittleEndian(header[20..]))
            : (Math.Abs((long)BinaryPrimitives.ReadInt32LittleEndian(header[18..])),
            Math.Abs((long)BinaryPrimitives.ReadInt32LittleEndian(header[22..])));

    /// <summary>With one of the six kinds of pixels that there are: 1 to 3, and 8 more for each of them in runs.</summary>
    private static (long Width, long Height)? ReadTgaSize(ReadOnlySpan<byte> header) =>
        header.Length < 18 || header[2] is not (1 or 2 or 3 or 9 or 10 or 11) ? null
        : (BinaryPrimitives.ReadUInt16LittleEndian(header[12..]), BinaryPrimitives.ReadUInt16LittleEndian(header[14..]));

    /// <summary>Goes from segment to segment until one begins a frame (ITU-T T.81, §B.2).</summary>
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
                    // Bytes of filling may stand before a marker.
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
