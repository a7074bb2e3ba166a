using System.Collections.Immutable;
using FractalEngine.Benchmarks.Measuring;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Parsing.Assets;
using FractalEngine.Render;
using FractalEngine.Render.Images;
using FractalEngine.Render.Preparation;
using FractalEngine.Render.Tracing;
using FractalEngine.Render.Views;
using FractalEngine.Render.Windowing;

namespace FractalEngine.Benchmarks.Light;

/// <summary>
/// How right is the light that haze scatters in drawn frames, and what does it cost? All surfaces are black, so that nothing else is seen,
/// and blocks of 8 × 8 pixels are compared with traced ones.
/// </summary>
internal static class FogTable
{
    /// <summary>Names of the table's columns.</summary>
    public static readonly string[] Columns =
    [
        "scene", "width", "height", "samples_of_truth", "blocks", "percent_within_1.5_db", "mean_db", "frame_ms_without", "frame_ms_with",
        "ratio",
    ];

    /// <summary>The scenes that are measured.</summary>
    public static readonly string[] Scenes = ["shafts", "menger", "gallery"];

    private const int BlockSize = 8;

    // Light up to 4 is shown. Darker blocks than this part of white are few steps of the screen's values.
    private const double Exposure = 0.25;
    private const double MinShown = 0.01;

    /// <summary>Measures one scene, in blocks of pixels and in whole frames.</summary>
    /// <param name="name">Of a file of scenes, which gets haze if it has none that scatters.</param>
    /// <param name="isQuick">Whether a smaller image with fewer samples will do.</param>
    /// <param name="folder">Receives the images; null for none.</param>
    public static object?[] Measure(string name, bool isQuick, string? folder)
    {
        var (width, height, samples) = isQuick ? (160, 96, 16) : (640, 360, 64);
        var scene = AssetLoader.Load(Path.Combine(FractalCase.Assets, "scenes", name + ".sdo")).Scene;
        var fog = scene.Scene.Fog is { IsLit: true } lit ? lit : new(1 / scene.Bounds.Diagonal) { Albedo = 0.9, Anisotropy = 0.3 };
        scene = scene with { Scene = scene.Scene with { Fog = fog } };
        var view = View.Of(scene, (double)width / height);
        var black = BlackOf(scene);
        using var renderer = Renderer.Offscreen(width, height, new());
        var drawn = renderer.Draw(black, view);
        var tracer = new PathTracer(black, view, width, height) { BounceLimit = 0 };
        for (var i = 0; i < samples; i++)
        {
            tracer.AddSample();
        }

        if (folder is not null)
        {
            drawn.SavePng(Path.Combine(folder, $"fog-{name}-drawn.png"));
            tracer.ToImage().SavePng(Path.Combine(folder, $"fog-{name}-truth.png"));
        }

        var errors = new List<double>();
        for (var i = 0; i < width / BlockSize * (height / BlockSize); i++)
        {
            var (left, top) = (BlockSize * (i % (width / BlockSize)), BlockSize * (i / (width / BlockSize)));
            var truth = Exposure * MeanOf(left, top, (x, y) => tracer.RadianceAt(x, y).Y);
            if (truth > MinShown)
            {
                var shown = MeanOf(left, top, (x, y) => new Colour(drawn[x, y].Green / 255.0, 0, 0).ToLinear().Red);
                errors.Add(Math.Abs(10 * Math.Log10(shown / truth)));
            }
        }

        var without = scene with { Scene = scene.Scene with { Fog = fog with { Albedo = 0 } } };
        var milliseconds = MeasureFrames([without, scene], view, isQuick ? 3 : 20);
        return
        [
            name, width, height, samples, errors.Count, Math.Round(100.0 * errors.Count(static error => error <= 1.5) / errors.Count, 2),
            Math.Round(errors.Average(), 3), Math.Round(milliseconds[0], 1), Math.Round(milliseconds[1], 1),
            Math.Round(milliseconds[1] / milliseconds[0], 3),
        ];
    }

    private static LoadedScene BlackOf(LoadedScene scene) => scene with
    {
        Scene = scene.Scene with
        {
            Sky = null,
            Background = Colour.Black,
            Tone = Tone.None,
            Exposure = Exposure,
            Fog = scene.Scene.Fog! with { Colour = Colour.Black },
        },
        Objects =
        [
            .. scene.Objects.Select(static item => new PlacedModel(
                item.Declaration with { Colour = Colour.Black, Gradient = null }, item.Model)),
        ],
    };

    private static double MeanOf(int left, int top, Func<int, int, double> light) => Enumerable.Range(0, BlockSize * BlockSize)
        .Average(i => light(left + (i % BlockSize), top + (i / BlockSize)));

    /// <summary>Measures frames of a camera that moves, in turns: the best processor time of each scene.</summary>
    private static double[] MeasureFrames(ImmutableArray<LoadedScene> scenes, View view, int rounds)
    {
        var settings = new AdaptiveQuality().Adapt(new());
        using var context = new OffscreenContext();
        using var frame = new FrameRenderer(context);
        var renderers = scenes.Select(scene => new SceneRenderer(context, DrawableScene.Prepare(scene, settings))).ToArray();
        var step = 1e-4 * scenes[0].Bounds.Diagonal * Vector.I;
        double[] best = [.. scenes.Select(static _ => double.PositiveInfinity)];
        for (var round = 0; round <= rounds; round++)
        {
            var moved = view with { Camera = view.Camera with { Position = view.Camera.Position + (round * step) } };
            for (var i = 0; i < scenes.Length; i++)
            {
                var start = Environment.CpuUsage.TotalTime;
                frame.Draw(renderers[i], moved, 1280, 720, settings);
                frame.Finish();
                var time = (Environment.CpuUsage.TotalTime - start).TotalMilliseconds;
                // In the first round, programs are compiled and maps drawn.
                best[i] = round > 0 ? Math.Min(best[i], time) : best[i];
            }
        }

        foreach (var renderer in renderers)
        {
            renderer.Dispose();
        }

        return best;
    }
}
