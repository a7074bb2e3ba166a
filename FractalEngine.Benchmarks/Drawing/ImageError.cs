using FractalEngine.Core.Images;

namespace FractalEngine.Benchmarks.Drawing;

/// <summary>Measures how far images are from each other, in the values that files hold (sRGB).</summary>
internal static class ImageError
{
    /// <summary>
    /// Computes the peak signal-to-noise ratio in decibels: 10·log₁₀(255² / mean square). It is infinite for equal images. Opacity is
    /// ignored.
    /// </summary>
    /// <exception cref="ArgumentException">The images are not of one size.</exception>
    public static double PeakSignalToNoiseRatio(PixelImage image1, PixelImage image2)
    {
        if ((image1.Width, image1.Height) != (image2.Width, image2.Height))
        {
            throw new ArgumentException($"expected {image1.Width} × {image1.Height} pixels, not {image2.Width} × {image2.Height}",
                nameof(image2));
        }

        var squares = 0L;
        for (var i = 0; i < image1.Pixels.Length; i++)
        {
            var difference = i % 4 == 3 ? 0 : image1.Pixels[i] - image2.Pixels[i];
            squares += difference * difference;
        }

        var meanSquare = squares / (0.75 * image1.Pixels.Length);
        return 10 * Math.Log10(255.0 * 255.0 / meanSquare);
    }

    /// <summary>Creates an image of the absolute difference of each value, opaque.</summary>
    public static PixelImage AbsoluteDifference(PixelImage image, PixelImage reference) => new(image.Width, image.Height,
        [.. image.Pixels.Select((value, i) => i % 4 == 3 ? byte.MaxValue : (byte)Math.Abs(value - reference.Pixels[i]))]);

    /// <summary>Creates an image of a difference: grey where there is none, brighter and darker by some times what there is.</summary>
    public static PixelImage Difference(PixelImage image, PixelImage reference, int factor)
    {
        var pixels = new byte[image.Pixels.Length];
        for (var i = 0; i < pixels.Length; i++)
        {
            var difference = image.Pixels[i] - reference.Pixels[i];
            pixels[i] = i % 4 == 3 ? byte.MaxValue : (byte)Math.Clamp(128 + (factor * difference), 0, 255);
        }

        return new(image.Width, image.Height, pixels);
    }

    /// <summary>Creates a smaller image: each pixel is the mean of a square of pixels, in linear light.</summary>
    public static PixelImage Downsample(PixelImage image, int factor) => Filter(image, factor, [.. Enumerable.Repeat(1.0, factor)]);

    /// <summary>
    /// Creates a smaller image as <see cref="Render.Tracing.PathTracer"/> filters its samples: pixels count the less the farther they are
    /// from the middle, down to nothing at the middles of the neighbours, in linear light.
    /// </summary>
    public static PixelImage DownsampleAsTraced(PixelImage image, int factor) =>
        Filter(image, factor, [.. Enumerable.Range(0, 2 * factor).Select(i => factor - Math.Abs(i + 0.5 - factor))]);

    /// <summary>Weighs squares of pixels around the middles of the new ones; the border counts for what lies beyond it.</summary>
    private static PixelImage Filter(PixelImage image, int factor, double[] weights)
    {
        var linear = new double[256];
        for (var i = 0; i < 256; i++)
        {
            var value = i / 255.0;
            linear[i] = value <= 0.04045 ? value / 12.92 : Math.Pow((value + 0.055) / 1.055, 2.4);
        }

        var (width, height) = (image.Width / factor, image.Height / factor);
        var before = (weights.Length - factor) / 2;
        var whole = weights.Sum() * weights.Sum();
        var pixels = new byte[4 * width * height];
        Parallel.For(0, height, y =>
        {
            for (var i = 0; i < 4 * width; i++)
            {
                var sum = 0.0;
                for (var down = 0; down < weights.Length; down++)
                {
                    var row = Math.Clamp((y * factor) + down - before, 0, image.Height - 1);
                    for (var across = 0; across < weights.Length; across++)
                    {
                        var column = Math.Clamp((i / 4 * factor) + across - before, 0, image.Width - 1);
                        sum += weights[down] * weights[across] * linear[image.Pixels[(4 * ((row * image.Width) + column)) + (i % 4)]];
                    }
                }

                var mean = sum / whole;
                var value = mean <= 0.0031308 ? 12.92 * mean : (1.055 * Math.Pow(mean, 1 / 2.4)) - 0.055;
                pixels[(y * 4 * width) + i] = (byte)Math.Round(255 * value);
            }
        });
        return new(width, height, pixels);
    }
}
