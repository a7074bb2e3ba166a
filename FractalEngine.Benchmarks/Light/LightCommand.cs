using System.Globalization;
using FractalEngine.Benchmarks.Drawing;
using FractalEngine.Benchmarks.Measuring;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Parsing.Assets;
using FractalEngine.Render;
using FractalEngine.Render.Preparation;
using FractalEngine.Render.Tracing;
using FractalEngine.Render.Windowing;

namespace FractalEngine.Benchmarks.Light;

/// <summary>Runs the command <c>light</c>: how right drawn light is beside traced light, and what it costs.</summary>
internal static class LightCommand
{
    private const string Usage = """
        light [SCENE ...] [--quick] [--output FOLDER]
          Pixels with wrong shadows, of a resting and of a moving camera; decibels of the drawn image to a traced one, without
          and with shadows; processor time of frames with shadows by that of frames without; writes light.csv.
        """;

    private static readonly string[] Columns =
    [
        "scene", "width", "height", "facing_pixels", "wrong_percent_resting", "wrong_percent_moving", "samples_of_truth",
        "db_vertex", "db_without_shadows", "db_with_shadows", "frame_ms_without_shadows", "frame_ms_with_shadows", "time_ratio",
    ];

    /// <summary>Runs the command and returns the exit code.</summary>
    /// <param name="args">The words after the command's name.</param>
    public static int Run(ReadOnlySpan<string> args)
    {
        var isQuick = false;
        var folder = CommandLineParser.DefaultFolder;
        var scenes = new List<string>();
        var parser = new CommandLineParser(Usage)
            .Flag("--quick", () => isQuick = true)
            .Option("--output", value => folder = value)
            .Names(static name => File.Exists(PathOf(name)), scenes);
        if (!parser.TryParse(args))
        {
            return 2;
        }

        if (scenes.Count == 0)
        {
            scenes.AddRange(isQuick ? ["menger"] : ["menger", "playground", "gallery"]);
        }

        var table = new TableOptions("light", isQuick, folder).CreateTable("light.csv", Columns);
        foreach (var scene in scenes)
        {
            var row = Measure(scene, isQuick);
            table.Add(row);
            Console.WriteLine(string.Join(' ', row.Select(static field => Convert.ToString(field, CultureInfo.InvariantCulture))));
        }

        table.Save();
        return 0;
    }

    private static string PathOf(string name) => Path.Combine(FractalCase.Assets, "scenes", name + ".sdo");

    private static object?[] Measure(string name, bool isQuick)
    {
        var (width, height) = isQuick ? (320, 180) : (1280, 720);
        var scene = AssetLoader.Load(PathOf(name)).Scene;
        var view = View.Of(scene, (double)width / height);
        var error = new ShadowError(scene, view, width, height);
        var (facing, resting) = error.Count(new());
        var (_, moving) = error.Count(new() { FitShadowsToView = false });

        // A traced image takes long: half the size shows the same.
        var (smallWidth, smallHeight, samples) = (width / 2, height / 2, isQuick ? 32 : 64);
        var tracer = new PathTracer(scene, view, smallWidth, smallHeight);
        for (var i = 0; i < samples; i++)
        {
            tracer.AddSample();
        }

        var truth = tracer.ToImage();
        var (without, with) = MeasureFrames(scene, view, isQuick ? 5 : 20);
        return
        [
            name, width, height, facing, Percent(resting, facing), Percent(moving, facing), samples,
            Decibels(new() { Shading = Shading.PerVertex }), Decibels(new() { Shadows = false }), Decibels(new()),
            Math.Round(without, 1), Math.Round(with, 1), Math.Round(with / without, 3),
        ];

        double Decibels(RenderSettings settings)
        {
            using var renderer = Renderer.Offscreen(smallWidth, smallHeight, settings);
            return Math.Round(ImageError.PeakSignalToNoiseRatio(renderer.Draw(scene, view), truth), 2);
        }
    }

    private static double Percent(int part, int whole) => Math.Round(100.0 * part / Math.Max(1, whole), 2);

    /// <summary>Measures frames of a camera that moves, in turns: the best processor time of each kind.</summary>
    private static (double Without, double With) MeasureFrames(LoadedScene scene, View view, int rounds)
    {
        var settings = new AdaptiveQuality().Adapt(new());
        using var context = new OffscreenContext();
        using var frame = new FrameRenderer(context);
        using var renderer = new SceneRenderer(context, DrawableScene.Prepare(scene, settings));
        var step = 1e-4 * scene.Bounds.Diagonal * Vector.I;
        var best = (Without: double.PositiveInfinity, With: double.PositiveInfinity);
        for (var round = 0; round <= rounds; round++)
        {
            var moved = view with { Camera = view.Camera with { Position = view.Camera.Position + (round * step) } };
            var without = Time(moved, settings with { Shadows = false });
            var with = Time(moved, settings);
            // In the first round, programs are compiled and maps drawn.
            if (round > 0)
            {
                best = (Math.Min(best.Without, without), Math.Min(best.With, with));
            }
        }

        return best;

        double Time(View shown, RenderSettings used)
        {
            // The view before made the other kind of frame cull as well.
            var before = shown.Camera with { Position = shown.Camera.Position - (0.5 * step) };
            frame.Draw(renderer, shown with { Camera = before }, 1280, 720, used);
            frame.Finish();
            var start = Environment.CpuUsage.TotalTime;
            frame.Draw(renderer, shown, 1280, 720, used);
            frame.Finish();
            return (Environment.CpuUsage.TotalTime - start).TotalMilliseconds;
        }
    }
}
