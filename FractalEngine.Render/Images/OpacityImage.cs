using FractalEngine.Core.Images;

namespace FractalEngine.Render.Images;

/// <summary>Reads the opacity of images, and puts that of one image into another.</summary>
internal static class OpacityImage
{
    // Alpha between these is soft: about 10 and 90 percent.
    private const int MinSoftAlpha = 26;
    private const int MaxSoftAlpha = 229;

    // Smoothed edges of leaves stay below this share of all pixels, smoke and gradients are above it.
    private const double MaxSharpShare = 0.25;

    /// <summary>Tells whether any pixel is not fully opaque.</summary>
    public static bool HasAlpha(PixelImage image)
    {
        // The alpha component is every fourth byte.
        for (var i = 3; i < image.Pixels.Length; i += 4)
        {
            if (image.Pixels[i] < byte.MaxValue)
            {
                return true;
            }
        }

        return false;
    }

    /// <summary>Tells whether many pixels are neither opaque nor invisible.</summary>
    public static bool IsSoft(PixelImage image)
    {
        var softCount = 0;
        for (var i = 3; i < image.Pixels.Length; i += 4)
        {
            softCount += image.Pixels[i] is >= MinSoftAlpha and <= MaxSoftAlpha ? 1 : 0;
        }

        return softCount > MaxSharpShare * image.Pixels.Length / 4;
    }

    /// <summary>Returns colours with the opacity of another image; where both have one, the smaller.</summary>
    /// <param name="colours">Colours, which give the size of the result; null for white of the size of the opacity.</param>
    /// <param name="opacity">Image whose alpha is the opacity, or its lightness if all of it is opaque.</param>
    public static PixelImage Combine(PixelImage? colours, PixelImage opacity)
    {
        var (width, height) = colours is null ? (opacity.Width, opacity.Height) : (colours.Width, colours.Height);
        var usesAlpha = HasAlpha(opacity);
        var pixels = new byte[4 * width * height];
        pixels.AsSpan().Fill(byte.MaxValue);
        colours?.Pixels.CopyTo(pixels, 0);
        for (var y = 0; y < height; y++)
        {
            var opacityRow = (int)((long)y * opacity.Height / height) * opacity.Width;
            for (var x = 0; x < width; x++)
            {
                var source = opacity.Pixels.AsSpan(4 * (opacityRow + (int)((long)x * opacity.Width / width)), 4);
                ref var alpha = ref pixels[(4 * ((y * width) + x)) + 3];
                alpha = Math.Min(alpha, usesAlpha ? source[3] : Lightness(source));
            }
        }

        return new(width, height, pixels);
    }

    /// <summary>The weights of ITU-R BT.709, on the values as they are stored; exact for grey.</summary>
    private static byte Lightness(ReadOnlySpan<byte> pixel) =>
        (byte)Math.Round((0.2126 * pixel[0]) + (0.7152 * pixel[1]) + (0.0722 * pixel[2]));
}
