using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;

namespace FractalEngine.Render.Lights;

/// <summary>From the light of a scene to the light of the screen, as display.glsl computes it: exposure, then the tone curve.</summary>
/// <param name="Exposure">Factor of all light.</param>
/// <param name="Tone">Curve behind it.</param>
internal readonly record struct DisplayTransform(double Exposure, Tone Tone)
{
    // The rational curve with which K. Narkowicz, "ACES Filmic Tone Mapping Curve", 2016, approximates that of the Academy.
    private const double A = 2.51;
    private const double B = 0.03;
    private const double C = 2.43;
    private const double D = 0.59;
    private const double E = 0.14;

    /// <summary>The shares of red, green and blue in the luminance of sRGB (IEC 61966-2-1).</summary>
    public static readonly Vector Luminance = new(0.2126, 0.7152, 0.0722);

    // The luminance that E. Reinhard and others, "Photographic Tone Reproduction for Digital Images",
    // 2002, equation 4, show as 1.
    private const double White = 4;

    // S. Hill's fit of the Academy's reference rendering and its output to sRGB, in M. Pettineo's BakingLab, 2016: columns of the maps
    // to and from its colours, and a rational curve between them.
    private static readonly Matrix ToAces = new(
        new(0.59719, 0.07600, 0.02840), new(0.35458, 0.90834, 0.13383), new(0.04823, 0.01566, 0.83777));

    private static readonly Matrix FromAces = new(
        new(1.60475, -0.10208, -0.00327), new(-0.53108, 1.10813, -0.07276), new(-0.07367, -0.00605, 1.07602));

    private static readonly Matrix ToAcesInverse = ToAces.Inverse();
    private static readonly Matrix FromAcesInverse = FromAces.Inverse();
    private const double Toe = 0.0245786;
    private const double Black = 0.000090537;
    private const double Slope = 0.983729;
    private const double Middle = 0.4329510;
    private const double Base = 0.238081;

    // Squares of larger ones leave the range of the shader's floats.
    private const double MaxLight = 1e18;

    /// <summary>Leaves light as it is: an exposure of 1, and no tone curve.</summary>
    public static DisplayTransform Identity { get; } = new(1, Tone.None);

    /// <summary>Whether light is shown as it is.</summary>
    public bool IsIdentity => this == Identity;

    /// <summary>The transform that a scene declares.</summary>
    public static DisplayTransform Of(Scene scene) => new(scene.Exposure, scene.Tone);

    /// <summary>Converts linear light of the scene to linear light of the screen.</summary>
    public Vector Apply(Vector light)
    {
        if (Tone is Tone.None or Tone.Filmic)
        {
            return new(Apply(light.X), Apply(light.Y), Apply(light.Z));
        }

        var x = Vector.Min(Exposure * light, MaxLight * Vector.One);
        var luminance = Vector.Dot(Luminance, x);
        var shown = Tone == Tone.Reinhard
            ? (1 + (luminance / (White * White))) / (1 + luminance) * x
            : FromAces * EachOf(ToAces * x, static v => ((v * (v + Toe)) - Black) / ((v * ((Slope * v) + Middle)) + Base));
        return Vector.Min(Vector.Max(shown, Vector.Zero), Vector.One);
    }

    private static Vector EachOf(Vector v, Func<double, double> map) => new(map(v.X), map(v.Y), map(v.Z));

    /// <summary>Converts linear light of the scene to what an image stores, from 0 to 1 or beyond where there is no tone curve.</summary>
    public Colour ToSrgb(Vector light)
    {
        var (x, y, z) = Apply(light);
        return new Colour(x, y, z).FromLinear();
    }

    /// <summary>Finds the light of the scene that is shown as given light of the screen, from 0 to 1.</summary>
    public Vector Invert(Vector shown)
    {
        if (Tone is Tone.None or Tone.Filmic)
        {
            return new(Invert(shown.X), Invert(shown.Y), Invert(shown.Z));
        }

        if (Tone == Tone.Aces)
        {
            // The positive root of the curve's quadratic equation.
            return 1 / Exposure * (ToAcesInverse * EachOf(FromAcesInverse * shown, static y =>
            {
                var (a, b) = (1 - (Slope * y), Toe - (Middle * y));
                return (-b + Math.Sqrt((b * b) + (4 * a * (Black + (Base * y))))) / (2 * a);
            }));
        }

        var luminance = Vector.Dot(Luminance, shown);
        var rest = 1 - luminance;
        return 2 / (Exposure * (rest + Math.Sqrt((rest * rest) + (4 * luminance / (White * White))))) * shown;
    }

    private double Apply(double light)
    {
        var x = Math.Min(Exposure * light, MaxLight);
        return Tone == Tone.None ? x : Math.Clamp(x * ((A * x) + B) / ((x * ((C * x) + D)) + E), 0, 1);
    }

    private double Invert(double shown)
    {
        if (Tone == Tone.None)
        {
            return shown / Exposure;
        }

        // The positive root of (A − C·y)·x² + (B − D·y)·x − E·y.
        var a = A - (C * shown);
        var b = B - (D * shown);
        return ((-b + Math.Sqrt((b * b) + (4 * a * E * shown))) / (2 * a)) / Exposure;
    }
}
