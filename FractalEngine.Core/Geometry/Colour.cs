using System.Globalization;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Geometry;

/// <summary>A colour with sRGB components from 0 to 1, as files and screens use them.</summary>
/// <param name="Red">Red component, from 0 to 1.</param>
/// <param name="Green">Green component, from 0 to 1.</param>
/// <param name="Blue">Blue component, from 0 to 1.</param>
public readonly record struct Colour(double Red, double Green, double Blue)
{
    /// <summary>The colour white, (1, 1, 1).</summary>
    public static Colour White => new(1, 1, 1);

    /// <summary>The colour black, (0, 0, 0).</summary>
    public static Colour Black => default;

    /// <summary>Converts the components to linear light by the curve of IEC 61966-2-1.</summary>
    /// <remarks>It is the inverse of the curve that the screen applies.</remarks>
    public Colour ToLinear() => new(Linear(Red), Linear(Green), Linear(Blue));

    /// <summary>Converts the colour to linear light as a vector, so that lights can be added and scaled: red, green, blue.</summary>
    public Vector ToLinearVector() => new(Linear(Red), Linear(Green), Linear(Blue));

    /// <summary>Converts components of linear light to sRGB, the inverse of <see cref="ToLinear"/>.</summary>
    public Colour FromLinear() => new(Curve(Red), Curve(Green), Curve(Blue));

    /// <summary>Formats the colour as files write it, in the invariant culture.</summary>
    public override string ToString() => string.Create(CultureInfo.InvariantCulture, $"({Red:R}, {Green:R}, {Blue:R})");

    private static double Linear(double component) =>
        component <= 0.04045 ? component / 12.92 : Math.Pow((component + 0.055) / 1.055, 2.4);

    private static double Curve(double linear) =>
        linear <= 0.0031308 ? 12.92 * linear : (1.055 * Math.Pow(linear, 1 / 2.4)) - 0.055;
}
