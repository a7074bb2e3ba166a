using FractalEngine.Core.Geometry;
using FractalEngine.Core.Images;
using FractalEngine.Core.Maths;
using FractalEngine.Render.Images;
using FractalEngine.Render.Lights;

namespace FractalEngine.Render.Tracing;

/// <summary>The light of an image's pixels as samples are added, and its conversion to what a screen shows.</summary>
/// <param name="width">Pixels.</param>
/// <param name="height">Pixels.</param>
internal sealed class RadianceImage(int width, int height)
{
    // In single precision, a million samples would add to a bright pixel no more.
    private readonly double[] _sums = new double[3 * width * height];

    /// <summary>Number of samples that the pixels of each row have.</summary>
    public int[] RowSamples { get; } = new int[height];

    /// <summary>Adds the radiance of a sample to a pixel. Threads may do so at once in different rows.</summary>
    public void Add(int x, int y, Vector radiance)
    {
        var sum = _sums.AsSpan(3 * ((y * width) + x), 3);
        sum[0] += radiance.X;
        sum[1] += radiance.Y;
        sum[2] += radiance.Z;
    }

    /// <summary>The mean radiance of a pixel so far.</summary>
    public Vector At(int x, int y)
    {
        var sum = _sums.AsSpan(3 * ((y * width) + x), 3);
        return new Vector(sum[0], sum[1], sum[2]) / Math.Max(1, RowSamples[y]);
    }

    /// <summary>Converts the present image to sRGB.</summary>
    /// <param name="display">From the light of the scene to that of the screen.</param>
    /// <param name="viewport">The part that shows the scene.</param>
    /// <param name="letterbox">Colour beside it.</param>
    /// <param name="isDithered">Whether values are rounded by an <see cref="OrderedDither"/>: a converged sky would show bands.</param>
    public PixelImage ToImage(
        DisplayTransform display, (int X, int Y, int Width, int Height) viewport, Colour letterbox, bool isDithered)
    {
        var height = RowSamples.Length;
        var pixels = new byte[4 * width * height];
        for (var y = 0; y < height; y++)
        {
            for (var x = 0; x < width; x++)
            {
                var target = pixels.AsSpan(4 * ((y * width) + x), 4);
                target[3] = byte.MaxValue;
                if (x < viewport.X || x >= viewport.X + viewport.Width || y < viewport.Y || y >= viewport.Y + viewport.Height)
                {
                    (target[0], target[1], target[2]) =
                        (ToByte(letterbox.Red, 0), ToByte(letterbox.Green, 0), ToByte(letterbox.Blue, 0));
                    continue;
                }

                var sum = _sums.AsSpan(3 * ((y * width) + x), 3);
                var scale = 1.0 / Math.Max(1, RowSamples[y]);
                var (red, green, blue) = display.ToSrgb(new(sum[0] * scale, sum[1] * scale, sum[2] * scale));
                var offset = isDithered ? OrderedDither.At(x, y) : 0;
                (target[0], target[1], target[2]) =
                    (ToByte(red, offset), ToByte(green, offset), ToByte(blue, offset));
            }
        }

        return new(width, height, pixels);
    }

    /// <summary>Returns the present light, with that which is shown as a colour beside the viewport.</summary>
    /// <param name="viewport">The part that shows the scene.</param>
    /// <param name="letterbox">Light beside it.</param>
    public FloatImage ToLight((int X, int Y, int Width, int Height) viewport, Vector letterbox)
    {
        var image = new FloatImage(width, RowSamples.Length, new float[_sums.Length]);
        for (var y = 0; y < image.Height; y++)
        {
            for (var x = 0; x < width; x++)
            {
                var isShown = x >= viewport.X && x < viewport.X + viewport.Width && y >= viewport.Y && y < viewport.Y + viewport.Height;
                image[x, y] = isShown ? At(x, y) : letterbox;
            }
        }

        return image;
    }

    private static byte ToByte(double component, double offset) =>
        (byte)Math.Clamp(Math.Round((255 * Math.Clamp(component, 0, 1)) + offset), 0, 255);

}
