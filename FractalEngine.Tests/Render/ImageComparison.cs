using FractalEngine.Core.Images;
using static System.FormattableString;

namespace FractalEngine.Tests.Render;

/// <summary>Measures of the difference between two images, in the values that files hold (sRGB).</summary>
internal static class ImageComparison
{
    /// <summary>
    /// Decibels from which images count as the same. An image of every instance of a fractal is itself 24 to 40 dB from the supersampled
    /// reference, which hides differences of 40 dB and more.
    /// </summary>
    public const double MinSameDecibels = 40;

    /// <summary>Peak signal-to-noise ratio in decibels: 20·log₁₀(255 / root of the mean square); infinite for equal images.</summary>
    public static double PeakSignalToNoiseRatio(PixelImage image1, PixelImage image2)
    {
        Assert.Equal((image1.Width, image1.Height), (image2.Width, image2.Height));
        var sum = 0.0;
        for (var i = 0; i < image1.Pixels.Length; i++)
        {
            var difference = i % 4 == 3 ? 0 : image1.Pixels[i] - image2.Pixels[i];
            sum += difference * difference;
        }

        return 20 * Math.Log10(255 / Math.Sqrt(sum / (0.75 * image1.Pixels.Length)));
    }

    /// <summary>Fails unless two images are the same up to <see cref="MinSameDecibels"/>.</summary>
    public static void AssertSame(PixelImage expected, PixelImage found, string description)
    {
        var ratio = PeakSignalToNoiseRatio(found, expected);
        Assert.True(ratio >= MinSameDecibels, Invariant($"{description}: {ratio:F1} dB"));
    }

    /// <summary>Returns a smaller image, by averages of squares of pixels in linear light.</summary>
    public static PixelImage Downsample(PixelImage image, int factor)
    {
        var linear = Enumerable.Range(0, 256).Select(i => i <= 10 ? i / 255.0 / 12.92 : Math.Pow(((i / 255.0) + 0.055) / 1.055, 2.4))
            .ToArray();
        var width = image.Width / factor;
        var height = image.Height / factor;
        var pixels = new byte[4 * width * height];
        var source = image.Pixels;
        Parallel.For(0, height, y =>
        {
            for (var i = 0; i < 4 * width; i++)
            {
                var sum = 0.0;
                for (var row = y * factor; row < (y + 1) * factor; row++)
                {
                    for (var column = i / 4 * factor; column < ((i / 4) + 1) * factor; column++)
                    {
                        sum += linear[source[(4 * ((row * image.Width) + column)) + (i % 4)]];
                    }
                }

                var mean = sum / (factor * factor);
                pixels[(y * 4 * width) + i] =
                    (byte)Math.Round(255 * (mean <= 0.0031308 ? 12.92 * mean : (1.055 * Math.Pow(mean, 1 / 2.4)) - 0.055));
            }
        });
        return new(width, height, pixels);
    }

    /// <summary>
    /// Returns the fraction of the lit pixels of one image that have no lit pixel of another within two pixels in each direction.
    /// </summary>
    public static double FractionWithoutNeighbour(PixelImage image1, PixelImage image2)
    {
        var count = 0;
        var isolated = 0;
        for (var y = 0; y < image1.Height; y++)
        {
            for (var x = 0; x < image1.Width; x++)
            {
                if (image1[x, y].Green > 0)
                {
                    count++;
                    isolated += HasLitNeighbour(image2, x, y) ? 0 : 1;
                }
            }
        }

        return (double)isolated / count;
    }

    private static bool HasLitNeighbour(PixelImage image, int x, int y)
    {
        for (var row = Math.Max(0, y - 2); row <= Math.Min(image.Height - 1, y + 2); row++)
        {
            for (var column = Math.Max(0, x - 2); column <= Math.Min(image.Width - 1, x + 2); column++)
            {
                if (image[column, row].Green > 0)
                {
                    return true;
                }
            }
        }

        return false;
    }
}
