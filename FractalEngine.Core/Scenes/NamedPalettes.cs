using System.Collections.Immutable;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Scenes;

/// <summary>The palettes that scenes call by name. Each grows lighter by even steps of the lightness of Oklab (Ottosson, 2020).</summary>
/// <remarks>
/// A palette is a line in lightness and hue. Its chroma is a number, or as much of it as a screen can show at that lightness and hue.
/// Between stops it is blended in linear light, by which lightness is up to 0.002 of white's off the line.
/// </remarks>
public static class NamedPalettes
{
    private const int StopCount = 65;

    /// <summary>All of them, in the order of the manual.</summary>
    public static ImmutableArray<Palette> All { get; } =
    [
        Make("slate", 0.2, 0.95, 250, 250, 0.02),
        Make("bark", 0.22, 0.86, 40, 78, 0.07),
        Make("gold", 0.25, 0.95, 50, 105, 0.15),
        Make("ember", 0.16, 0.96, 10, 106, 0.2),
        Make("rose", 0.24, 0.95, 350, 385, 0.17),
        Make("plum", 0.18, 0.93, 300, 345, 0.15),
        Make("dusk", 0.18, 0.94, 275, 435, 0.16),
        Make("ice", 0.3, 0.98, 268, 210, 0.1),
        Make("sea", 0.18, 0.94, 280, 185, 0.13),
        Make("lagoon", 0.2, 0.95, 270, 110, 0.16),
        Make("aurora", 0.18, 0.95, 325, 130, 0.18),
        Make("moss", 0.2, 0.94, 165, 112, 0.15),
    ];

    /// <summary>Finds a palette by its name; null where there is none.</summary>
    public static Palette? Find(string name) => All.FirstOrDefault(palette => palette.Name == name);

    private static Palette Make(string name, double dark, double light, double firstHue, double lastHue, double chroma) => Palette.OfEven(
        [.. Enumerable.Range(0, StopCount).Select(i => i / (StopCount - 1.0)).Select(part => Fit(
            dark + (part * (light - dark)), double.DegreesToRadians(firstHue + (part * (lastHue - firstHue))), chroma))], name);

    /// <summary>The colour of a lightness and a hue, with as much of a chroma as sRGB has there.</summary>
    private static Colour Fit(double lightness, double hue, double chroma)
    {
        var (low, high) = (0.0, chroma);
        for (var i = 0; i < 50 && !IsShown(ToLinear(lightness, hue, high)); i++)
        {
            var middle = 0.5 * (low + high);
            (low, high) = IsShown(ToLinear(lightness, hue, middle)) ? (middle, high) : (low, middle);
        }

        var linear = Vector.Max(Vector.Zero, Vector.Min(Vector.One, ToLinear(lightness, hue, high)));
        return new Colour(linear.X, linear.Y, linear.Z).FromLinear();
    }

    private static bool IsShown(Vector linear) => Vector.Max(Vector.Zero, Vector.Min(Vector.One, linear)) == linear;

    /// <summary>Converts a colour of Oklab to linear light of sRGB, by the matrices of its paper.</summary>
    private static Vector ToLinear(double lightness, double hue, double chroma)
    {
        var a = chroma * Math.Cos(hue);
        var b = chroma * Math.Sin(hue);
        var l = Cube(lightness + (0.3963377774 * a) + (0.2158037573 * b));
        var m = Cube(lightness - (0.1055613458 * a) - (0.0638541728 * b));
        var s = Cube(lightness - (0.0894841775 * a) - (1.2914855480 * b));
        return new(
            (4.0767416621 * l) - (3.3077115913 * m) + (0.2309699292 * s),
            (-1.2684380046 * l) + (2.6097574011 * m) - (0.3413193965 * s),
            (-0.0041960863 * l) - (0.7034186147 * m) + (1.7076147010 * s));
    }

    private static double Cube(double number) => number * number * number;
}
