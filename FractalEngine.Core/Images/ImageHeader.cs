using System.Buffers.Binary;

namespace FractalEngine.Core.Images;

/// <summary>
/// What the header of an image file says, so that its size is known, and a lie about it found, before memory is allocated.
/// </summary>
/// <param name="Width">Pixels, as the file states them; may be 0 in a damaged file.</param>
/// <param name="Height">Pixels, as the file states them; may be 0 in a damaged file.</param>
/// <param name="MinFileBytes">
/// Bytes that the file has at least if it holds so many pixels: all but padding where they are not compressed, else by the greatest ratio.
/// </param>
public readonly record struct ImageHeader(long Width, long Height, long MinFileBytes)
{
    // Bytes that hold the size and the depth in a PNG, BMP or TGA file.
    private const int HeaderBytes = 34;

    // Deflate (RFC 1951, §3.2.5): 258 bytes by a length and a distance of one bit each.
    private const int DeflateRatio = 1032;

    // JPEG (T.81, §G.1.2): a bit for a block of 8×8 samples, whose rows and columns may each stand for two of the largest component.
    private const int JpegPixelsPerByte = 8 * 64 * 4;

    // BMP: an escape of four bytes skips up to 255 rows and columns.
    private const int BmpSkippedPixelsPerByte = 255 * 255 / 4;

    // TGA: a packet of one pixel stands for up to 128.
    private const int TgaPacketPixels = 128;

    /// <summary>The first colour of a TGA image's palette; 0 where it begins with the first, or there is none.</summary>
    private int FirstColour { get; init; }

    /// <summary>Pixels of the whole image.</summary>
    public long PixelCount => PixelBytes(Width, Height, 8);

    /// <summary>
    /// The most bytes that the pixels of a PNG image take before they are compressed. Interlaced, it has less than two rows for each of its
    /// own. A row begins with a byte that names its filter, and may end with one that is not full.
    /// </summary>
    internal long MaxPngDataBytes => ((MinFileBytes + 1) * DeflateRatio) + (4 * Height) + 14;

    /// <summary>Reads the header of a PNG, JPEG, BMP or TGA file; null for any other file.</summary>
    /// <param name="stream">Seekable stream at its beginning; afterwards anywhere. Left open.</param>
    /// <param name="isTga">As <see cref="IsTga"/> says, because that format has no signature.</param>
    /// <exception cref="IOException">The stream can't be read.</exception>
    public static ImageHeader? Read(Stream stream, bool isTga)
    {
        ArgumentNullException.ThrowIfNull(stream);
        Span<byte> header = stackalloc byte[HeaderBytes];
        header.Clear();
        var count = stream.ReadAtLeast(header, HeaderBytes, throwOnEndOfStream: false);
        return header switch
        {
            // Another chunk before the header could have a decoder take it for an image of another size.
            _ when IsPng(header) => count < 24 || !header[12..].StartsWith("IHDR"u8) ? null : ReadPng(header),
            [0xFF, 0xD8, ..] => ReadJpeg(stream),
            [(byte)'B', (byte)'M', ..] => count < 26 ? null : ReadBmp(header),
            _ when isTga => count < 18 ? null : ReadTga(header),
            _ => null,
        };
    }

    /// <summary>Whether a file that begins so is a PNG image.</summary>
    /// <param name="head">The first eight bytes, or more.</param>
    public static bool IsPng(ReadOnlySpan<byte> head) => head.StartsWith(PngChunk.Signature);

    /// <summary>Whether the name of a file says that it is a TGA image, which its contents can't.</summary>
    public static bool IsTga(string path) => Path.GetExtension(path).Equals(".tga", StringComparison.OrdinalIgnoreCase);

    /// <summary>
    /// Tells whether a file is too short for the pixels that its header states, or has a palette without its first colours: decoders
    /// show others.
    /// </summary>
    /// <param name="fileBytes">The length of the file.</param>
    /// <returns>The rest of a sentence that begins with the name of the image; null where there is no such fault.</returns>
    public string? FindFault(long fileBytes) =>
        fileBytes < MinFileBytes
            ? $"is cut off: {Width}×{Height} pixels need at least {MinFileBytes} bytes, and it has {fileBytes}"
            : FirstColour > 0 ? $"has a palette that begins with colour {FirstColour}, expected 0"
            : null;

    private static ImageHeader ReadPng(ReadOnlySpan<byte> header)
    {
        long width = BinaryPrimitives.ReadUInt32BigEndian(header[16..]);
        long height = BinaryPrimitives.ReadUInt32BigEndian(header[20..]);
        var channels = header[25] switch
        {
            2 => 3,
            4 => 2,
            6 => 4,
            _ => 1,
        };
        return new(width, height, PixelBytes(width, height, channels * header[24]) / DeflateRatio);
    }

    private static ImageHeader ReadBmp(ReadOnlySpan<byte> header)
    {
        // The oldest kind of header has 12 bytes and 16-bit numbers.
        if (BinaryPrimitives.ReadUInt32LittleEndian(header[14..]) == 12)
        {
            long oldWidth = BinaryPrimitives.ReadUInt16LittleEndian(header[18..]);
            long oldHeight = BinaryPrimitives.ReadUInt16LittleEndian(header[20..]);
            var oldBits = BinaryPrimitives.ReadUInt16LittleEndian(header[24..]);
            return new(oldWidth, oldHeight, PixelStart(header) + PixelBytes(oldWidth, oldHeight, oldBits));
        }

        // A negative height means that the rows run from top to bottom.
        var width = Math.Abs((long)BinaryPrimitives.ReadInt32LittleEndian(header[18..]));
        var height = Math.Abs((long)BinaryPrimitives.ReadInt32LittleEndian(header[22..]));
        var bits = BinaryPrimitives.ReadUInt16LittleEndian(header[28..]);
        var isRunLength = BinaryPrimitives.ReadUInt32LittleEndian(header[30..]) is 1 or 2;
        var pixelBytes = isRunLength ? PixelBytes(width, height, 8) / BmpSkippedPixelsPerByte : PixelBytes(width, height, bits);
        return new(width, height, PixelStart(header) + pixelBytes);
    }

    private static long PixelStart(ReadOnlySpan<byte> header) => BinaryPrimitives.ReadUInt32LittleEndian(header[10..]);

    /// <summary>Reads the header of an image with one of the six pixel types: 1 to 3, and 9 to 11 for run-length encoding.</summary>
    private static ImageHeader? ReadTga(ReadOnlySpan<byte> header)
    {
        if (header[2] is not (1 or 2 or 3 or 9 or 10 or 11))
        {
            return null;
        }

        long width = BinaryPrimitives.ReadUInt16LittleEndian(header[12..]);
        long height = BinaryPrimitives.ReadUInt16LittleEndian(header[14..]);
        // The header, a text, and a palette precede the pixels.
        var paletteBytes = header[1] == 0 ? 0 : BinaryPrimitives.ReadUInt16LittleEndian(header[5..]) * ((header[7] + 7) / 8);
        var start = 18 + header[0] + paletteBytes;
        var bytesPerPixel = (header[16] + 7) / 8;
        var isCompressed = header[2] >= 9;
        var packets = (PixelBytes(width, height, 8) + TgaPacketPixels - 1) / TgaPacketPixels;
        var pixelBytes = isCompressed ? packets * (1 + bytesPerPixel) : PixelBytes(width, height, 8 * bytesPerPixel);
        return new(width, height, start + pixelBytes)
        {
            FirstColour = header[2] is 1 or 9 ? BinaryPrimitives.ReadUInt16LittleEndian(header[3..]) : 0,
        };
    }

    /// <summary>Reads the header of a JPEG image from its first frame segment (ITU-T T.81, §B.2).</summary>
    private static ImageHeader? ReadJpeg(Stream stream)
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
                    long width = BinaryPrimitives.ReadUInt16BigEndian(segment[7..]);
                    long height = BinaryPrimitives.ReadUInt16BigEndian(segment[5..]);
                    // Arithmetic coding, from SOF9 on, knows no greatest ratio.
                    return new(width, height, segment[1] > 0xC8 ? 0 : width * height / JpegPixelsPerByte);
                default:
                    position += 2 + BinaryPrimitives.ReadUInt16BigEndian(segment[2..]);
                    break;
            }
        }
    }

    /// <summary>Bytes of so many pixels without any compression. A depth of 0, which is damage, counts as one bit.</summary>
    private static long PixelBytes(long width, long height, int bits) =>
        (long)Int128.Min((Int128)width * height * Math.Max(1, bits) / 8, long.MaxValue / 2);
}
