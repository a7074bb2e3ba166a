using FractalEngine.Core.Geometry;
using FractalEngine.Core.Images;

namespace FractalEngine.Render.Images;

/// <summary>
/// Finds the opacity of each pixel from two images of the same scene, one on black and one on white (Smith and Blinn, "Blue Screen
/// Matting", 1996). It is exact for edges and transparent materials alike, whatever the renderer blends.
/// </summary>
public static class Matting
{
    private const int Levels = 256;

    // From a stored sRGB value to linear light.
    internal static readonly double[] Linear =
        [.. Enumerable.Range(0, Levels).Select(static level => new Colour(level / 255.0, 0, 0).ToLinear().Red)];

    /// <summary>Combines two opaque images to one with the opacity in its alpha.</summary>
    /// <param name="onBlack">The scene before black.</param>
    /// <param name="onWhite">The scene before white.</param>
    public static PixelImage Combine(PixelImage onBlack, PixelImage onWhite)
    {
        var pixels = new byte[onBlack.Pixels.Length];
        for (var i = 0; i < pixels.Length; i += 4)
        {
            var black = onBlack.Pixels.AsSpan(i, 3);
            var white = onWhite.Pixels.AsSpan(i, 3);
            if (black.SequenceEqual(white))
            {
                black.CopyTo(pixels.AsSpan(i));
                pixels[i + 3] = byte.MaxValue;
                continue;
            }

            // Light that comes through from behind is what white has more than black. The channel in which it shows best decides.
            var through = Math.Max(Through(black[0], white[0]), Math.Max(Through(black[1], white[1]), Through(black[2], white[2])));
            var opacity = Math.Clamp(1 - through, 0, 1);
            pixels[i + 3] = (byte)Math.Round(255 * opacity);
            for (var channel = 0; channel < 3 && pixels[i + 3] > 0; channel++)
            {
                pixels[i + channel] = Encode(Linear[black[channel]] / opacity);
            }
        }

        return new(onBlack.Width, onBlack.Height, pixels);
    }

    private static double Through(byte black, byte white) => Linear[white] - Linear[black];

    /// <summary>Returns the stored value that is nearest to an amount of linear light.</summary>
    internal static byte Encode(double light)
    {
        var index = Array.BinarySearch(Linear, Math.Min(light, 1));
        if (index >= 0)
        {
            return (byte)index;
        }

        var above = Math.Min(~index, Levels - 1);
        return (byte)(above > 0 && light - Linear[above - 1] < Linear[above] - light ? above - 1 : above);
    }
}
