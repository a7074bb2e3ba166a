using FractalEngine.App.Shell;
using FractalEngine.Core.Images;

namespace FractalEngine.App.Jobs;

/// <summary>The difference of two images of the same size.</summary>
/// <param name="PeakSignalToNoise">Peak signal-to-noise ratio of the sRGB values in decibels; infinite for equal images.</param>
/// <param name="Image">The absolute difference of each value, opaque.</param>
internal sealed record ImageDifference(double PeakSignalToNoise, PixelImage Image)
{
    /// <summary>Compares red, green and blue of all pixels. Opacity is ignored.</summary>
    /// <exception cref="UsageException">The images have different sizes.</exception>
    public static ImageDifference Between(PixelImage image, PixelImage reference)
    {
        if ((image.Width, image.Height) != (reference.Width, reference.Height))
        {
            throw new UsageException(
                $"the reference has {reference.Width}×{reference.Height} pixels, and the image {image.Width}×{image.Height}");
        }

        var pixels = new byte[image.Pixels.Length];
        var squares = 0L;
        for (var i = 0; i < pixels.Length; i++)
        {
            var difference = Math.Abs(image.Pixels[i] - reference.Pixels[i]);
            var isAlpha = i % 4 == 3;
            pixels[i] = isAlpha ? byte.MaxValue : (byte)difference;
            squares += isAlpha ? 0 : difference * difference;
        }

        var meanSquare = squares / (0.75 * pixels.Length);
        return new(10 * Math.Log10(255.0 * 255.0 / meanSquare), new(image.Width, image.Height, pixels));
    }
}
