using System.Buffers.Binary;

namespace FractalEngine.Core.Images;

/// <summary>The chunks <c>PLTE</c> and <c>tRNS</c> (PNG, third edition, §11.2.2 and §11.3.1.1), which say what samples look like.</summary>
/// <param name="header">Of the same image.</param>
internal sealed class PngColours(PngHeader header)
{
    private const int MaxEntries = 256;

    // RGBA, black and opaque where nothing is said.
    private readonly byte[] _palette = new byte[4 * MaxEntries];
    private bool _hasTransparency;

    /// <summary>Colours of the palette, RGBA. [<see cref="EntryCount"/> × 4]</summary>
    public ReadOnlySpan<byte> Palette => _palette.AsSpan(0, 4 * EntryCount);

    /// <summary>The number of colours; 0 where there is no palette.</summary>
    public int EntryCount { get; private set; }

    /// <summary>The one or three samples of the pixel value that is transparent, of the image's bit depth; null if none is.</summary>
    public ushort[]? TransparentSamples { get; private set; }

    /// <summary>Reads the current chunk, a <c>PLTE</c>.</summary>
    /// <exception cref="PngException">It is out of place, has no whole number of colours, or too many.</exception>
    public void ReadPalette(PngChunkReader chunks)
    {
        if (header.ColourType is PngColourType.Grey or PngColourType.GreyAlpha)
        {
            throw new PngException(chunks.Start, "a palette (PLTE) in an image of grey");
        }

        if (EntryCount > 0 || _hasTransparency)
        {
            throw new PngException(chunks.Start, EntryCount > 0 ? "a second palette (PLTE)" : "the palette (PLTE) stands after tRNS");
        }

        if (chunks.Remaining is < 3 or > 3 * MaxEntries || chunks.Remaining % 3 != 0)
        {
            throw new PngException(chunks.Start, $"a palette (PLTE) of {chunks.Remaining} bytes, expected 3 for each of 1 to 256 colours");
        }

        Span<byte> colours = stackalloc byte[3 * MaxEntries];
        colours = colours[..chunks.Remaining];
        chunks.ReadAll(colours);
        EntryCount = colours.Length / 3;
        for (var i = 0; i < EntryCount; i++)
        {
            colours.Slice(3 * i, 3).CopyTo(_palette.AsSpan(4 * i));
            _palette[(4 * i) + 3] = byte.MaxValue;
        }
    }

    /// <summary>Reads the current chunk, a <c>tRNS</c>. Where each pixel has an alpha already it says nothing, and is ignored.</summary>
    /// <exception cref="PngException">It is out of place or of a wrong length.</exception>
    public void ReadTransparency(PngChunkReader chunks)
    {
        if (_hasTransparency)
        {
            throw new PngException(chunks.Start, "a second tRNS");
        }

        _hasTransparency = true;
        switch (header.ColourType)
        {
            case PngColourType.Palette:
                ReadAlphas(chunks);
                break;
            case PngColourType.Grey or PngColourType.Rgb:
                ReadTransparentSamples(chunks);
                break;
            default:
                chunks.Ignore();
                break;
        }
    }

    private void ReadAlphas(PngChunkReader chunks)
    {
        if (EntryCount == 0)
        {
            throw new PngException(chunks.Start, "tRNS stands before the palette (PLTE)");
        }

        if (chunks.Remaining > EntryCount)
        {
            throw new PngException(
                chunks.Start, $"a tRNS of {chunks.Remaining} bytes, expected at most one for each of {EntryCount} colours");
        }

        Span<byte> alphas = stackalloc byte[MaxEntries];
        alphas = alphas[..chunks.Remaining];
        chunks.ReadAll(alphas);
        for (var i = 0; i < alphas.Length; i++)
        {
            _palette[(4 * i) + 3] = alphas[i];
        }
    }

    private void ReadTransparentSamples(PngChunkReader chunks)
    {
        var expected = 2 * header.Channels;
        if (chunks.Remaining != expected)
        {
            throw new PngException(chunks.Start, $"a tRNS of {chunks.Remaining} bytes, expected {expected}");
        }

        Span<byte> data = stackalloc byte[6];
        data = data[..expected];
        chunks.ReadAll(data);
        var samples = new ushort[header.Channels];
        for (var i = 0; i < samples.Length; i++)
        {
            // Bits beyond the depth have no meaning.
            samples[i] = (ushort)(BinaryPrimitives.ReadUInt16BigEndian(data[(2 * i)..]) & ((1 << header.BitDepth) - 1));
        }

        TransparentSamples = samples;
    }
}
