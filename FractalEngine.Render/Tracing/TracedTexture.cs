using FractalEngine.Core.Geometry;
using FractalEngine.Core.Images;
using FractalEngine.Core.Maths;

namespace FractalEngine.Render.Tracing;

/// <summary>A decoded image as a traced surface samples it: linear light, bilinear between the centres of pixels.</summary>
/// <param name="image">The pixels, sRGB.</param>
/// <param name="mapping">Scale, offset, and whether the image repeats.</param>
internal sealed class TracedTexture(PixelImage image, MaterialTexture mapping)
{
    private static readonly float[] LinearOfByte = [.. Enumerable.Range(0, 256).Select(static value =>
        (float)new Colour(value / 255.0, 0, 0).ToLinear().Red)];

    /// <summary>The size of one pixel in texture coordinates.</summary>
    public (double U, double V) PixelSize =>
        (1.0 / (image.Width * Math.Abs(mapping.Scale.U)), 1.0 / (image.Height * Math.Abs(mapping.Scale.V)));

    /// <summary>The factor of heights, for an image of heights.</summary>
    public double BumpFactor => mapping.BumpFactor;

    /// <summary>Samples the colour, linear light, and the opacity from 0 to 1.</summary>
    public (Vector Colour, double Opacity) Sample(double u, double v)
    {
        var (x, y, weightX, weightY) = Locate(u, v);
        var (colour, opacity) = (Vector.Zero, 0.0);
        for (var i = 0; i < 4; i++)
        {
            var weight = ((i & 1) == 0 ? 1 - weightX : weightX) * ((i & 2) == 0 ? 1 - weightY : weightY);
            var (red, green, blue, alpha) = image[Wrap(x + (i & 1), image.Width), Wrap(y + (i >> 1), image.Height)];
            colour += weight * new Vector(LinearOfByte[red], LinearOfByte[green], LinearOfByte[blue]);
            opacity += weight * (alpha / 255.0);
        }

        return (colour, opacity);
    }

    /// <summary>Samples the stored values from 0 to 1, as images of normals and heights mean them.</summary>
    public Vector SampleValues(double u, double v)
    {
        var (x, y, weightX, weightY) = Locate(u, v);
        var values = Vector.Zero;
        for (var i = 0; i < 4; i++)
        {
            var weight = ((i & 1) == 0 ? 1 - weightX : weightX) * ((i & 2) == 0 ? 1 - weightY : weightY);
            var (red, green, blue, _) = image[Wrap(x + (i & 1), image.Width), Wrap(y + (i >> 1), image.Height)];
            values += weight / 255 * new Vector(red, green, blue);
        }

        return values;
    }

    /// <summary>Finds the pixel to the upper left of a point, and how far beyond its centre the point is.</summary>
    private (int X, int Y, double WeightX, double WeightY) Locate(double u, double v)
    {
        // Images are stored from the top, texture coordinates count from the bottom.
        var x = (Fraction((mapping.Scale.U * u) + mapping.Offset.U) * image.Width) - 0.5;
        var y = ((1 - Fraction((mapping.Scale.V * v) + mapping.Offset.V)) * image.Height) - 0.5;
        var (left, top) = (Math.Floor(x), Math.Floor(y));
        return ((int)left, (int)top, x - left, y - top);
    }

    private double Fraction(double coordinate)
    {
        var fraction = mapping.IsClamped ? Math.Clamp(coordinate, 0, 1) : coordinate - Math.Floor(coordinate);
        // A coordinate times a large scale may be infinite, and then has no fraction.
        return double.IsNaN(fraction) ? 0 : fraction;
    }

    private int Wrap(int index, int size) => mapping.IsClamped
        ? Math.Clamp(index, 0, size - 1)
        : index < 0 ? index + size : index >= size ? index - size : index;
}
