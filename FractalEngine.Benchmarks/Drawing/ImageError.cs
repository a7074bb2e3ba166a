using FractalEngine.Core.Images;

namespace FractalEngine.Benchmarks.Drawing;

/// <summary>Measures how far images are from each other, in the values that files hold (sRGB).</summary>
internal static class ImageError
{
    /// <summary>
    /// Computes the peak signal-to-noise ratio in decibels: 20·log₁₀(255 / root of the mean square). It is infinite for equal images.
    /// </summary>
    /// <exception cref="ArgumentException">The images are not of one size.</exception>
    public static double PeakSignalToNoiseRatio(PixelImage image1, PixelImage image2)
    {
        if ((image1.Width, image1.Height) != (image2.Width, image2.Height))
        {
            throw new ArgumentException($"expected {image1.Width} × {image1.Height} pixels, not {image2.Width} × {image2.Height}",
                nameof(image2));
        }

        var sum = 0.0;
        for (var i = 0; i < image1.Pixels.Length; i++)
        {
            var difference = i % 4 == 3 ? 0 : image1.Pixels[i] - image2.Pixels[i];
            sum += difference * difference;
        }

        return 20 * Math.Log10(255 / Math.Sqrt(sum / (0.75 * image1.Pixels.Length)));
    }

    /// <summary>Creates a smaller image: each pixel is the mean of a square of pixels, in linear light.</summary>
    public static PixelImage Downsample(PixelImage image, int factor)
    {
        var linear = new double[256];
        for (var i = 0; i < 256; i++)
        {
            var value = i / 255.0;
            linear[i] = value <= 0.04045 ? value / 12.92 : Math.Pow((value + 0.055) / 1.055, 2.4);
        }

        var (width, height) = (image.Width / factor, image.Height / factor);
        var pixels = new byte[4 * width * height];
        Parallel.For(0, height, y =>
        {
            for (var i = 0; i < 4 * width; i++)
            {
                var sum = 0.0;
                for (var row = y * factor; row < (y + 1) * factor; row++)
                {
                    for (var column = i / 4 * factor; column < ((i / 4) + 1) * factor; column++)
                    {
                        sum += linear[image.Pixels[(4 * ((row * image.Width) + column)) + (i % 4)]];
                    }
                }

                var mean = sum / (factor * factor);
                var value = mean <= 0.0031308 ? 12.92 * mean : (1.055 * Math.Pow(mean, 1 / 2.4)) - 0.055;
                pixels[(y * 4 * width) + i] = (byte)Math.Round(255 * value);
            }
        });
        return new(width, height, pixels);
    }
}
