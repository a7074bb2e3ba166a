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

    // Squares of larger ones leave the range of the shader's floats.
    private const double MaxLight = 1e18;

    /// <summary>Shows light as it is.</summary>
    public static DisplayTransform Identity { get; } = new(1, Tone.None);

    /// <summary>Whether light is shown as it is.</summary>
    public bool IsIdentity => this == Identity;

    /// <summary>The transform that a scene declares.</summary>
    public static DisplayTransform Of(Scene scene) => new(scene.Exposure, scene.Tone);

    /// <summary>Converts linear light of the scene to linear light of the screen.</summary>
    public Vector Apply(Vector light) => new(Apply(light.X), Apply(light.Y), Apply(light.Z));

    /// <summary>Converts linear light of the scene to what an image stores, from 0 to 1 or beyond where there is no tone curve.</summary>
    public Vector ToSrgb(Vector light) => new(ToSrgb(Apply(light.X)), ToSrgb(Apply(light.Y)), ToSrgb(Apply(light.Z)));

    // The curve of IEC 61966-2-1.
    private static double ToSrgb(double linear) =>
        linear <= 0.0031308 ? 12.92 * linear : (1.055 * Math.Pow(linear, 1 / 2.4)) - 0.055;

    /// <summary>Finds the light of the scene that is shown as given light of the screen, from 0 to 1.</summary>
    public Vector Invert(Vector shown) => new(Invert(shown.X), Invert(shown.Y), Invert(shown.Z));

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
