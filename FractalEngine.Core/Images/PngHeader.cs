using System.Buffers.Binary;

namespace FractalEngine.Core.Images;

/// <summary>What a PNG file says of itself in its first chunk, <c>IHDR</c> (PNG, third edition, §11.2.1).</summary>
/// <param name="Width">Pixels, from 1 to 2³¹ − 1.</param>
/// <param name="Height">Pixels, from 1 to 2³¹ − 1.</param>
/// <param name="BitDepth">Bits a sample or palette index: 1, 2, 4, 8 or 16.</param>
/// <param name="ColourType">Colour type: which components the samples of a pixel are.</param>
/// <param name="IsInterlaced">Whether the pixels come in the seven passes of Adam7.</param>
public readonly record struct PngHeader(int Width, int Height, int BitDepth, PngColourType ColourType, bool IsInterlaced)
{
    internal const int Bytes = 13;

    /// <summary>Samples a pixel, 1 to 4.</summary>
    public int Channels => ColourType switch
    {
        PngColourType.Rgb => 3,
        PngColourType.GreyAlpha => 2,
        PngColourType.Rgba => 4,
        _ => 1,
    };

    /// <summary>Bits of a pixel in the file, before compression: 1 to 64.</summary>
    public int BitsPerPixel => Channels * BitDepth;

    /// <summary>The distance between bytes that filters compare, 1 to 8: that of a pixel, or one byte where pixels are smaller.</summary>
    internal int FilterDistance => (BitsPerPixel + 7) / 8;

    /// <summary>Bytes that a row of pixels takes in the file, before compression, without the byte that names its filter.</summary>
    internal int RowBytes(int pixels) => checked((int)((((long)pixels * BitsPerPixel) + 7) / 8));

    /// <summary>Reads the 13 bytes of the chunk.</summary>
    /// <param name="data">Its contents.</param>
    /// <param name="offset">Where they begin in the file, for messages.</param>
    /// <exception cref="PngException">The standard allows no such image.</exception>
    internal static PngHeader Parse(ReadOnlySpan<byte> data, long offset)
    {
        var width = BinaryPrimitives.ReadUInt32BigEndian(data);
        var height = BinaryPrimitives.ReadUInt32BigEndian(data[4..]);
        var depth = data[8];
        var colourType = data[9];
        if (width is 0 or > int.MaxValue || height is 0 or > int.MaxValue)
        {
            throw new PngException(offset, $"an image of {width}×{height} pixels, expected 1 to 2147483647 a side");
        }

        var isKnown = colourType switch
        {
            0 => depth is 1 or 2 or 4 or 8 or 16,
            3 => depth is 1 or 2 or 4 or 8,
            2 or 4 or 6 => depth is 8 or 16,
            _ => throw new PngException(offset + 9, $"colour type {colourType}, expected 0, 2, 3, 4 or 6"),
        };
        if (!isKnown)
        {
            throw new PngException(offset + 8, $"colour type {colourType} with {depth} bits, which the standard does not allow");
        }

        RequireZero(data[10], offset + 10, "compression method");
        RequireZero(data[11], offset + 11, "filter method");
        if (data[12] > 1)
        {
            throw new PngException(offset + 12, $"interlace method {data[12]}, expected 0 or 1");
        }

        return new((int)width, (int)height, depth, (PngColourType)colourType, data[12] == 1);
    }

    private static void RequireZero(byte value, long offset, string name)
    {
        if (value != 0)
        {
            throw new PngException(offset, $"{name} {value}, expected 0");
        }
    }
}
