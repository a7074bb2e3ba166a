using FractalEngine.Core.Images;

namespace FractalEngine.Render.Images;

/// <summary>The mean of images in linear light, as a shutter that is open meanwhile would take it.</summary>
/// <param name="width">Width of the images in pixels.</param>
/// <param name="height">Height of the images in pixels.</param>
/// <remarks>Takes 32 bytes a pixel. The mean of equal images is that image.</remarks>
public sealed class ImageMean(int width, int height)
{
    // Red, green and blue in linear light times the opacity, and the opacity, [width × height × 4].
    private readonly double[] _sums = new double[4 * width * height];
    private int _count;

    /// <summary>Takes an image into the mean, with as much weight as each other.</summary>
    /// <param name="image">Of the size of the others, transparent or not.</param>
    /// <exception cref="ArgumentException">The image has another size.</exception>
    public void Add(PixelImage image)
    {
        ArgumentNullException.ThrowIfNull(image);
        if ((image.Width, image.Height) != (width, height))
        {
            throw new ArgumentException("expected an image of the size of the others", nameof(image));
        }

        _count++;
        var pixels = image.Pixels;
        for (var i = 0; i < pixels.Length; i += 4)
        {
            double opacity = pixels[i + 3];
            for (var channel = 0; channel < 3; channel++)
            {
                _sums[i + channel] += opacity * Matting.Linear[pixels[i + channel]];
            }

            _sums[i + 3] += opacity;
        }
    }

    /// <summary>Returns the mean of all images so far.</summary>
    /// <exception cref="InvalidOperationException">There is none.</exception>
    public PixelImage ToImage()
    {
        if (_count == 0)
        {
            throw new InvalidOperationException("no image was added");
        }

        var pixels = new byte[_sums.Length];
        for (var i = 0; i < pixels.Length; i++)
        {
            var opacity = _sums[i | 3];
            pixels[i] = (i & 3) == 3 ? (byte)Math.Round(opacity / _count) : opacity > 0 ? Matting.Encode(_sums[i] / opacity) : (byte)0;
        }

        return new(width, height, pixels);
    }
}
