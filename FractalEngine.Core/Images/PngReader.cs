namespace FractalEngine.Core.Images;

/// <summary>Reads PNG images (W3C, "Portable Network Graphics (PNG) Specification", third edition).</summary>
/// <remarks>
/// Reads every colour type, bit depth, filter and interlacing of the standard, with palettes and transparency. Colour management
/// (<c>gAMA</c>, <c>cHRM</c>, <c>sRGB</c>, <c>iCCP</c>, <c>cICP</c>) is ignored: samples are taken as sRGB. Of an animation the static
/// image is read. A file that breaks the standard is refused, unless that leaves no pixel in doubt. Ignored are, as in libpng, damage
/// within chunks that are not used, palettes longer than indices reach, compressed data beyond the last pixel, a zlib checksum that is cut
/// off, alpha stated twice, and bytes after the last chunk.
/// </remarks>
public static class PngReader
{
    /// <summary>The most pixels that are read unless stated otherwise: 512 MiB, decoded.</summary>
    public const long DefaultMaxPixels = 1L << 27;

    /// <summary>The most pixels of a side, as in libpng: a row of the file takes at most 8 MB.</summary>
    public const int MaxSide = 1_000_000;

    /// <summary>Whether a file that begins so is a PNG image.</summary>
    /// <param name="head">The first eight bytes, or more.</param>
    public static bool IsPng(ReadOnlySpan<byte> head) => head.StartsWith(PngChunk.Signature);

    /// <summary>Reads what an image says of itself: its first 33 bytes.</summary>
    /// <param name="stream">At the beginning of the image; left open. Need not seek.</param>
    /// <exception cref="PngException">The file is no PNG, or its header is damaged.</exception>
    /// <exception cref="IOException">The stream can't be read.</exception>
    public static PngHeader ReadHeader(Stream stream)
    {
        ArgumentNullException.ThrowIfNull(stream);
        return ReadHeader(new PngChunkReader(stream));
    }

    /// <summary>Reads an image from a stream.</summary>
    /// <param name="stream">At the beginning of the image; left open. Need not seek. Read to the end of the image, not beyond.</param>
    /// <param name="maxPixels">The most pixels that are read; no memory is taken for an image that has more.</param>
    /// <returns>Samples of less than 8 bits are spread over the whole range, those of 16 bits rounded to the nearest of 8.</returns>
    /// <exception cref="PngException">The file is no PNG, is damaged, or has more pixels than the limit.</exception>
    /// <exception cref="IOException">The stream can't be read.</exception>
    /// <exception cref="ArgumentOutOfRangeException">The limit is less than 1.</exception>
    /// <remarks>
    /// Takes 4 bytes a pixel of the stated size, four rows and 128 KiB, whatever the file contains, and time linear in both the
    /// pixels and the length of the file. Costs 5 to 20 ns a pixel, most of it decompression.
    /// </remarks>
    public static PixelImage Read(Stream stream, long maxPixels = DefaultMaxPixels)
    {
        ArgumentNullException.ThrowIfNull(stream);
        ArgumentOutOfRangeException.ThrowIfLessThan(maxPixels, 1);
        var chunks = new PngChunkReader(stream);
        var header = ReadHeader(chunks);
        CheckSize(header, maxPixels);
        var pixels = ReadPixels(header, chunks);
        return new(header.Width, header.Height, pixels);
    }

    private static PngHeader ReadHeader(PngChunkReader chunks)
    {
        chunks.ReadSignature();
        chunks.Advance();
        if (chunks.Type != PngChunk.Header || chunks.Remaining != PngHeader.Bytes)
        {
            throw new PngException(
                chunks.Start, $"the chunk {PngChunk.Name(chunks.Type)} of {chunks.Remaining} bytes, expected IHDR of {PngHeader.Bytes}");
        }

        var offset = chunks.Position;
        Span<byte> data = stackalloc byte[PngHeader.Bytes];
        chunks.ReadAll(data);
        return PngHeader.Parse(data, offset);
    }

    private static void CheckSize(PngHeader header, long maxPixels)
    {
        var size = $"an image of {header.Width}×{header.Height} pixels";
        const int Offset = 16;
        if (Math.Max(header.Width, header.Height) > MaxSide)
        {
            throw new PngException(Offset, $"{size}, more than the limit of {MaxSide} a side");
        }

        maxPixels = Math.Min(maxPixels, Array.MaxLength / 4);
        if ((long)header.Width * header.Height > maxPixels)
        {
            throw new PngException(Offset, $"{size}, more than the limit of {maxPixels} in all");
        }
    }

    private static byte[] ReadPixels(PngHeader header, PngChunkReader chunks)
    {
        var colours = new PngColours(header);
        byte[]? pixels = null;
        chunks.Advance();
        while (chunks.Type != PngChunk.End)
        {
            switch (chunks.Type)
            {
                case PngChunk.Data when pixels is not null:
                    throw new PngException(chunks.Start, "a chunk IDAT apart from the others");
                case PngChunk.Data when header.ColourType == PngColourType.Palette && colours.EntryCount == 0:
                    throw new PngException(chunks.Start, "the pixels come before their palette (PLTE)");
                case PngChunk.Data:
                    pixels = PngImageData.Decode(header, colours, chunks);
                    // It went on to the next chunk by itself.
                    continue;
                case PngChunk.Palette or PngChunk.Transparency when pixels is not null:
                    throw new PngException(chunks.Start, $"{PngChunk.Name(chunks.Type)} stands after the pixels");
                case PngChunk.Palette:
                    colours.ReadPalette(chunks);
                    break;
                case PngChunk.Transparency:
                    colours.ReadTransparency(chunks);
                    break;
                case PngChunk.Header:
                    throw new PngException(chunks.Start, "a second IHDR");
                case var type when PngChunk.IsCritical(type):
                    throw new PngException(chunks.Start, $"the unknown chunk {PngChunk.Name(type)}, without which the image can't be read");
                default:
                    chunks.Ignore();
                    break;
            }

            chunks.Advance();
        }

        if (chunks.Remaining > 0)
        {
            throw new PngException(chunks.Start, "the chunk IEND is not empty");
        }

        var end = chunks.Start;
        chunks.Finish();
        return pixels ?? throw new PngException(end, "the image has no pixels (IDAT)");
    }
}
