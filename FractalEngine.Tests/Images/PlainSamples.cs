using FractalEngine.Core.Images;

namespace FractalEngine.Tests.Images;

/// <summary>The samples of an image as a PNG file holds them, and what they look like once decoded.</summary>
/// <param name="Width">Pixels.</param>
/// <param name="Height">Pixels.</param>
/// <param name="ColourType">0, 2, 3, 4 or 6.</param>
/// <param name="Depth">Bits a sample.</param>
/// <param name="IsInterlaced">Whether the file has passes.</param>
/// <param name="Values">[height × width × channels]</param>
internal sealed record PlainSamples(int Width, int Height, int ColourType, int Depth, bool IsInterlaced, ushort[] Values)
{
    /// <summary>All fifteen kinds.</summary>
    public static readonly (int ColourType, int Depth)[] Kinds =
        [(0, 1), (0, 2), (0, 4), (0, 8), (0, 16), (2, 8), (2, 16), (3, 1), (3, 2), (3, 4), (3, 8), (4, 8), (4, 16), (6, 8), (6, 16)];

    /// <summary>Red, green, blue. [entries × 3]</summary>
    public byte[]? Palette { get; init; }

    /// <summary>The chunk <c>tRNS</c>.</summary>
    public byte[]? Transparency { get; init; }

    public int Channels => ChannelsOf(ColourType);

    /// <summary>Random samples, half of them with transparency: some pixels have the transparent colour, and some nearly do.</summary>
    public static PlainSamples Random(Random random, int colourType, int depth, bool isInterlaced, int width, int height)
    {
        var channels = ChannelsOf(colourType);
        var entries = random.Next(1, (1 << Math.Min(depth, 8)) + 1);
        var highest = colourType == 3 ? entries : 1 << depth;
        var transparent = Enumerable.Range(0, channels).Select(_ => (ushort)random.Next(highest)).ToArray();
        var values = new ushort[width * height * channels];
        for (var i = 0; i < values.Length; i++)
        {
            // Half of the samples repeat what is above or to the left, so that filters and compression have something to find.
            values[i] = random.Next(4) switch
            {
                0 when i >= channels => values[i - channels],
                1 => transparent[i % channels],
                2 when colourType != 3 => (ushort)(transparent[i % channels] ^ (1 << random.Next(depth))),
                _ => (ushort)random.Next(highest),
            };
        }

        return new(width, height, colourType, depth, isInterlaced, values)
        {
            Palette = colourType == 3 ? Bytes(random, 3 * entries) : null,
            Transparency = (random.Next(2), colourType) switch
            {
                (1, 0 or 2) => [.. transparent.SelectMany(sample => new[] { (byte)(sample >> 8), (byte)sample })],
                (1, 3) => Bytes(random, random.Next(entries + 1)),
                _ => null,
            },
        };
    }

    public ReadOnlySpan<ushort> Pixel(int x, int y) => Values.AsSpan(((y * Width) + x) * Channels, Channels);

    /// <summary>What each pixel looks like.</summary>
    public PixelImage ToImage()
    {
        var pixels = new List<byte>();
        for (var y = 0; y < Height; y++)
        {
            for (var x = 0; x < Width; x++)
            {
                pixels.AddRange(Colour(Pixel(x, y)));
            }
        }

        return new(Width, Height, [.. pixels]);
    }

    private byte[] Colour(ReadOnlySpan<ushort> pixel) => ColourType switch
    {
        0 => [Scale(pixel[0]), Scale(pixel[0]), Scale(pixel[0]), Alpha(pixel)],
        2 => [Scale(pixel[0]), Scale(pixel[1]), Scale(pixel[2]), Alpha(pixel)],
        3 => [.. Palette.AsSpan(3 * pixel[0], 3), Transparency is { } alphas && pixel[0] < alphas.Length ? alphas[pixel[0]] : (byte)255],
        4 => [Scale(pixel[0]), Scale(pixel[0]), Scale(pixel[0]), Scale(pixel[1])],
        _ => [Scale(pixel[0]), Scale(pixel[1]), Scale(pixel[2]), Scale(pixel[3])],
    };

    /// <summary>Spreads a sample over the whole range; of 16 bits, the upper 8 are left.</summary>
    private byte Scale(ushort sample) => (byte)(Depth == 16 ? sample >> 8 : 255 * sample / ((1 << Depth) - 1));

    private byte Alpha(ReadOnlySpan<ushort> pixel)
    {
        if (Transparency is null)
        {
            return 255;
        }

        for (var i = 0; i < pixel.Length; i++)
        {
            if (pixel[i] != ((Transparency[2 * i] << 8) | Transparency[(2 * i) + 1]))
            {
                return 255;
            }
        }

        return 0;
    }

    private static int ChannelsOf(int colourType) => colourType switch { 2 => 3, 4 => 2, 6 => 4, _ => 1 };

    private static byte[] Bytes(Random random, int count)
    {
        var bytes = new byte[count];
        random.NextBytes(bytes);
        return bytes;
    }
}
