using System.Globalization;

namespace FractalEngine.Core.Geometry;

/// <summary>A colour as files and screens write it: sRGB components from 0 to 1.</summary>
/// <param name="Red">0..1.</param>
/// <param name="Green">0..1.</param>
/// <param name="Blue">0..1.</param>
public readonly record struct Colour(double Red, double Green, double Blue)
{
    /// <summary>White.</summary>
    public static Colour White => new(1, 1, 1);

    /// <summary>Black.</summary>
    public static Colour Black => default;

    /// <summary>The components divided into light: IEC 61966-2-1's curve, the inverse of what the screen applies.</summary>
    public Colour ToLinear() => new(Linear(Red), Linear(Green), Linear(Blue));

    /// <summary>As files write it, invariant culture.</summary>
    public override string ToString() => string.Create(CultureInfo.InvariantCulture, $"({Red:R}, {Green:R}, {Blue:R})");

    private static double Linear(double component) =>
        component <= 0.04045 ? component / 12.92 : Math.Pow((component + 0.055) / 1.055, 2.4);
}
