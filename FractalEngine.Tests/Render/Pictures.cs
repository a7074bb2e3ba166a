using FractalEngine.Render.Pictures;

namespace FractalEngine.Tests.Render;

/// <summary>How far pictures are from each other, in the values that files hold (sRGB).</summary>
internal static class Pictures
{
    /// <summary>Peak signal-to-noise ratio in decibels: 20·log₁₀(255 / root of the mean square); infinite for equal pictures.</summary>
    public static double Ratio(PixelImage image1, PixelImage image2)
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

    /// <summary>A smaller picture: averages of squares of pixels in linear light.</summary>
    public static PixelImage Shrunk(PixelImage image, int factor)
    {
        var linear = Enumerable.Range(0, 256).Select(i => i <= 10 ? i / 255.0 / 12.92 : Math.Pow(((i / 255.0) + 0.055) / 1.055, 2.4)).ToArray();
        var (width, height) = (image.Width / factor, image.Height / factor);
        var (pixels, source) = (new byte[4 * width * height], image.Pixels);
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
                pixels[(y * 4 * width) + i] = (byte)Math.Round(255 * (mean <= 0.0031308 ? 12.92 * mean : (1.055 * Math.Pow(mean, 1 / 2.4)) - 0.055));
            }
        });
        return new(width, height, pixels);
    }
}
