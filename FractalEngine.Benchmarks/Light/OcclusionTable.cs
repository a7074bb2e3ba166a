using FractalEngine.Benchmarks.Drawing;
using FractalEngine.Benchmarks.Measuring;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Geometry.Surfaces;
using FractalEngine.Core.Images;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Scenes.Lights;
using FractalEngine.Core.Visibility.Levels;
using FractalEngine.Core.Visibility.SkyBaking;
using FractalEngine.Parsing.Assets;
using FractalEngine.Render;
using FractalEngine.Render.Images;
using FractalEngine.Render.Tracing;
using FractalEngine.Render.Views;

namespace FractalEngine.Benchmarks.Light;

/// <summary>
/// How right is light from all around within fractals? Dark fractals under a white sky are drawn, and traced with many rays a pixel: what
/// is seen is the part of the sky that each point sees.
/// </summary>
/// <remarks>
/// A frame has four samples a pixel, which all count the same. A traced image has many, over the neighbouring pixels too. At edges both
/// differ by more than occlusion is wrong. So images of four times the size, filtered as the traced one is, are compared too.
/// </remarks>
internal static class OcclusionTable
{
    /// <summary>Names of the table's columns.</summary>
    public static readonly string[] Columns =
    [
        "fractal", "rays_of_truth", "db_without", "db_with", "db_filtered_without", "db_filtered_with", "has_masks", "bake_ms", "bytes",
    ];

    /// <summary>The fractals that are measured.</summary>
    public static readonly string[] Fractals =
    [
        "menger-4", "menger", "tetrahedron", "sierpinski", "tree-leaves", "tree", "romanesco", "terrain", "mountain",
    ];

    // So dark that hardly any light is reflected twice, and shown so many times brighter.
    private const double Exposure = 25;

    // Pixels of a filtered image along each axis, for one of the traced image.
    private const int Magnification = 4;

    private static readonly Colour Dark = new(0.22, 0.22, 0.22);

    /// <summary>Measures the drawn light within one fractal.</summary>
    /// <param name="name">Name of its file, without the ending.</param>
    /// <param name="isQuick">Whether a smaller image with fewer rays will do.</param>
    /// <param name="folder">Receives the images; null for none.</param>
    public static object?[] Measure(string name, bool isQuick, string? folder = null)
    {
        var (width, height, rays) = isQuick ? (240, 180, 32) : (480, 360, 128);
        var file = AssetLoader.Load(Path.Combine(FractalCase.Assets, "fractals", name + ".fdo")).Scene;
        var placed = file.Objects[0];
        var scene = file with
        {
            Scene = file.Scene with { Lights = [new AmbientLight(Colour.White, 1)], Background = Colour.Black, Exposure = Exposure },
            Objects = [new(placed.Declaration with { Colour = Dark }, placed.Model)],
        };
        var view = View.Of(scene, (double)width / height);
        var tracer = new PathTracer(scene, view, width, height);
        for (var i = 0; i < rays; i++)
        {
            tracer.AddSample();
        }

        var truth = tracer.ToImage();
        var settings = new RenderSettings();
        var settingsWithout = settings with { AmbientOcclusion = false };
        var with = Draw(settings, 1);
        var filtered = ImageError.DownsampleAsTraced(Draw(settings, Magnification), Magnification);
        var filteredWithout = ImageError.DownsampleAsTraced(Draw(settingsWithout, Magnification), Magnification);
        if (folder is not null)
        {
            truth.SavePng(Path.Combine(folder, name + "-truth.png"));
            with.SavePng(Path.Combine(folder, name + "-with.png"));
            filtered.SavePng(Path.Combine(folder, name + "-filtered.png"));
        }

        var (hasMasks, milliseconds, bytes) = Bake((FractalModel)placed.Model);
        return
        [
            name, rays, Decibels(Draw(settingsWithout, 1)), Decibels(with), Decibels(filteredWithout), Decibels(filtered), hasMasks,
            Math.Round(milliseconds), bytes,
        ];

        PixelImage Draw(RenderSettings used, int factor)
        {
            using var renderer = Renderer.Offscreen(factor * width, factor * height, used);
            return renderer.Draw(scene, view);
        }

        double Decibels(PixelImage image) => Math.Round(ImageError.PeakSignalToNoiseRatio(image, truth), 1);
    }

    private static (bool HasMasks, double Milliseconds, int Bytes) Bake(FractalModel model)
    {
        var hierarchy = LodHierarchy.Build(model.Fractal);
        var start = Environment.CpuUsage.TotalTime;
        SkyMaskBaker.Bake(hierarchy, ClosedSurface.IsSolid(model.Mesh) ? 1 : 0);
        return (hierarchy.HasSkyMasks, (Environment.CpuUsage.TotalTime - start).TotalMilliseconds, hierarchy.SkyMaskBytes);
    }
}
