using System.Buffers.Binary;
using System.Runtime.InteropServices;
using System.Runtime.Intrinsics;

namespace FractalEngine.Core.Images;

/// <summary>Converts rows of samples, as a file has them, into RGBA of 8 bits. Allocates nothing.</summary>
internal sealed class PngRowConverter
{
    private readonly PngHeader _header;
    private readonly ushort[]? _transparent;

    // RGBA for each value of a sample of up to 8 bits, and how many of them are allowed. [256 × 4]
    private readonly byte[] _table = new byte[4 * 256];
    private readonly int _tableCount;

    /// <summary>Creates the converter of an image.</summary>
    /// <param name="header">Of the image.</param>
    /// <param name="colours">Its palette and transparency, read completely.</param>
    public PngRowConverter(PngHeader header, PngColours colours)
    {
        _header = header;
        _transparent = colours.TransparentSamples;
        if (header.ColourType == PngColourType.Palette)
        {
            colours.Palette.CopyTo(_table);
            _tableCount = colours.EntryCount;
        }
        else if (header is { ColourType: PngColourType.Grey, BitDepth: <= 8 })
        {
            _tableCount = 1 << header.BitDepth;
            FillTableOfGrey();
        }
    }

    /// <summary>Converts one row to RGBA.</summary>
    /// <param name="samples">The restored bytes of the row.</param>
    /// <param name="pixels">RGBA. [pixels × 4]</param>
    /// <returns>False where an index is beyond the palette.</returns>
    public bool TryConvert(ReadOnlySpan<byte> samples, Span<byte> pixels)
    {
        switch (_header.ColourType, _header.BitDepth)
        {
            case (PngColourType.Palette, _) or (PngColourType.Grey, <= 8):
                return TryLookUp(samples, MemoryMarshal.Cast<byte, uint>(pixels));
            case (PngColourType.Grey, _):
                ConvertGrey16(samples, pixels);
                return true;
            case (PngColourType.Rgb, 8):
                ConvertRgb(samples, pixels);
                return true;
            case (PngColourType.Rgb, _):
                ConvertRgb16(samples, pixels);
                return true;
            case (PngColourType.GreyAlpha, var depth):
                ConvertGreyAlpha(samples, pixels, depth / 8);
                return true;
            case (_, 8):
                samples.CopyTo(pixels);
                return true;
            default:
                ConvertRgba16(samples, pixels);
                return true;
        }
    }

    /// <summary>Reduces 16 bits to the nearest of 8: round(v · 255 / 65535), which has no ties (PNG, third edition, §13.12).</summary>
    internal static byte Reduce(ushort value) => (byte)(((value * 255) + 32895) >> 16);

    private static byte Reduce(ReadOnlySpan<byte> sample) => Reduce(BinaryPrimitives.ReadUInt16BigEndian(sample));

    private void FillTableOfGrey()
    {
        for (var value = 0; value < _tableCount; value++)
        {
            var grey = (byte)(value * 255 / (_tableCount - 1));
            var alpha = IsTransparent(value) ? byte.MinValue : byte.MaxValue;
            Set(_table.AsSpan(4 * value), grey, grey, grey, alpha);
        }
    }

    private bool TryLookUp(ReadOnlySpan<byte> samples, Span<uint> pixels)
    {
        var table = MemoryMarshal.Cast<byte, uint>(_table);
        var highest = 0;
        if (_header.BitDepth == 8)
        {
            samples = samples[..pixels.Length];
            for (var i = 0; i < samples.Length; i++)
            {
                var value = samples[i];
                highest = Math.Max(highest, value);
                pixels[i] = table[value];
            }
        }
        else
        {
            // The leftmost pixel has the highest bits of a byte.
            var depth = _header.BitDepth;
            var mask = (1 << depth) - 1;
            for (var i = 0; i < pixels.Length; i++)
            {
                var bit = (long)i * depth;
                var value = (samples[(int)(bit >> 3)] >> (8 - depth - (int)(bit & 7))) & mask;
                highest = Math.Max(highest, value);
                pixels[i] = table[value];
            }
        }

        return highest < _tableCount;
    }

    private void ConvertGrey16(ReadOnlySpan<byte> samples, Span<byte> pixels)
    {
        for (; pixels.Length > 0; pixels = pixels[4..], samples = samples[2..])
        {
            var value = BinaryPrimitives.ReadUInt16BigEndian(samples);
            var grey = Reduce(value);
            Set(pixels, grey, grey, grey, IsTransparent(value) ? byte.MinValue : byte.MaxValue);
        }
    }

    private void ConvertRgb(ReadOnlySpan<byte> samples, Span<byte> pixels)
    {
        if (_transparent is null)
        {
            // Four pixels a step: the shuffle puts a zero where alpha belongs, which becomes 255.
            var places = Vector128.Create((byte)0, 1, 2, 16, 3, 4, 5, 16, 6, 7, 8, 16, 9, 10, 11, 16);
            var opaque = Vector128.Create((byte)0, 0, 0, 255, 0, 0, 0, 255, 0, 0, 0, 255, 0, 0, 0, 255);
            for (; samples.Length >= Vector128<byte>.Count; samples = samples[12..], pixels = pixels[16..])
            {
                (Vector128.Shuffle(Vector128.Create(samples), places) | opaque).CopyTo(pixels);
            }
        }

        for (; pixels.Length > 0; pixels = pixels[4..], samples = samples[3..])
        {
            var red = samples[0];
            var green = samples[1];
            var blue = samples[2];
            Set(pixels, red, green, blue, IsTransparent(red, green, blue) ? byte.MinValue : byte.MaxValue);
        }
    }

    private void ConvertRgb16(ReadOnlySpan<byte> samples, Span<byte> pixels)
    {
        for (; pixels.Length > 0; pixels = pixels[4..], samples = samples[6..])
        {
            var red = BinaryPrimitives.ReadUInt16BigEndian(samples);
            var green = BinaryPrimitives.ReadUInt16BigEndian(samples[2..]);
            var blue = BinaryPrimitives.ReadUInt16BigEndian(samples[4..]);
            // Compared before the reduction: only the exact colour is transparent.
            Set(pixels, Reduce(red), Reduce(green), Reduce(blue), IsTransparent(red, green, blue) ? byte.MinValue : byte.MaxValue);
        }
    }

    private static void ConvertGreyAlpha(ReadOnlySpan<byte> samples, Span<byte> pixels, int bytes)
    {
        for (; pixels.Length > 0; pixels = pixels[4..], samples = samples[(2 * bytes)..])
        {
            var grey = bytes == 1 ? samples[0] : Reduce(samples);
            Set(pixels, grey, grey, grey, bytes == 1 ? samples[1] : Reduce(samples[2..]));
        }
    }

    private static void ConvertRgba16(ReadOnlySpan<byte> samples, Span<byte> pixels)
    {
        for (; pixels.Length > 0; pixels = pixels[4..], samples = samples[8..])
        {
            Set(pixels, Reduce(samples), Reduce(samples[2..]), Reduce(samples[4..]), Reduce(samples[6..]));
        }
    }

    private static void Set(Span<byte> pixel, byte red, byte green, byte blue, byte alpha)
    {
        pixel[3] = alpha;
        pixel[2] = blue;
        pixel[1] = green;
        pixel[0] = red;
    }

    private bool IsTransparent(int grey) => _transparent is not null && _transparent[0] == grey;

    private bool IsTransparent(int red, int green, int blue) =>
        _transparent is not null && _transparent[0] == red && _transparent[1] == green && _transparent[2] == blue;
}
