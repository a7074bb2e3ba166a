using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Render.Lights;
using FractalEngine.Render.Views;

namespace FractalEngine.Render.Tracing;

/// <summary>Finds the exposure of scenes that leave it to what an image shows.</summary>
/// <remarks>
/// The logarithmic mean of the luminances becomes a middle grey, as in E. Reinhard and others, "Photographic Tone Reproduction for Digital
/// Images", 2002, equations 1 and 2. A small image is traced for it, so that drawn and traced images of a view have the same exposure.
/// </remarks>
public static class ExposureMeter
{
    private const double MiddleGrey = 0.18;
    private const double MinExposure = 1e-9;
    private const double MaxExposure = 1e9;

    // Of the small image.
    private const int MaxSide = 64;
    private const int SampleCount = 8;

    // Parts of the luminances that don't count: holes and shadows, and lamps and highlights.
    private const double DarkShare = 0.1;
    private const double BrightShare = 0.05;

    /// <summary>Gives a scene the exposure that a view of it needs; others are returned as they are.</summary>
    /// <param name="scene">With its models loaded.</param>
    /// <param name="view">Camera and projection.</param>
    /// <param name="width">Width of the image in pixels.</param>
    /// <param name="height">Height of the image in pixels.</param>
    /// <param name="settings">The crease angle.</param>
    /// <remarks>The same bits on any number of threads. Costs about 30,000 paths, and the preparation of the scene for rays.</remarks>
    public static LoadedScene Expose(LoadedScene scene, View view, int width, int height, RenderSettings settings)
    {
        ArgumentNullException.ThrowIfNull(scene);
        ArgumentNullException.ThrowIfNull(view);
        var declared = scene.Scene;
        if (!declared.HasAutoExposure)
        {
            return scene;
        }

        var scale = Math.Min(1, (double)MaxSide / Math.Max(width, height));
        // A background is shown as it is declared: black ones don't count.
        var measured = declared with { Background = declared is { Background: null, Sky: not null } ? null : Colour.Black };
        var tracer = new PathTracer(
            scene with { Scene = measured }, view, Math.Max(1, (int)(scale * width)), Math.Max(1, (int)(scale * height)), settings);
        for (var i = 0; i < SampleCount; i++)
        {
            tracer.AddSample();
        }

        var luminances = Enumerable.Range(0, tracer.Width * tracer.Height).Select(
            pixel => Vector.Dot(DisplayTransform.Luminance, tracer.RadianceAt(pixel % tracer.Width, pixel / tracer.Width)));
        var exposure = Math.Clamp(declared.Exposure * ExposureOf(luminances), MinExposure, MaxExposure);
        return scene with { Scene = declared with { Exposure = exposure, HasAutoExposure = false } };
    }

    /// <summary>Computes the exposure that shows luminances around a middle grey; 1 where none is positive.</summary>
    internal static double ExposureOf(IEnumerable<double> luminances)
    {
        var logarithms = luminances.Where(static luminance => luminance > 0)
            .Select(static luminance => Math.Log(luminance)).Order().ToArray();
        var kept = logarithms[(int)(DarkShare * logarithms.Length)..(logarithms.Length - (int)(BrightShare * logarithms.Length))];
        return kept.Length == 0 ? 1 : MiddleGrey / Math.Exp(kept.Average());
    }
}
