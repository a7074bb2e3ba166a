using System.Globalization;
using FractalEngine.Benchmarks.Drawing;
using FractalEngine.Benchmarks.Measuring;
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

/// <summary>Runs the command <c>light</c>: how right drawn light is beside traced light, and what it costs.</summary>
internal static class LightCommand
{
    private const string Usage = """
        light [SCENE ...] [--quick] [--no-truth] [--images FOLDER] [--output FOLDER]
          Pixels with wrong shadows, of a resting and of a moving camera; decibels of the drawn image to a traced one, without
          both, with shadows, with occlusion too; processor time of frames likewise; writes light.csv.
          Unless scenes are named, also the light from all around within fractals, to a traced image; writes occlusion.csv.
          Likewise white balls of all materials under a white sky; writes furnace.csv.
          Likewise the noise of very many lamps, sampled by importance and uniformly, at about equal time; writes lamps.csv.
          Likewise what the denoiser gains, to a traced image of many samples; writes denoise.csv, for an hour.
          Likewise what flickers when the eye moves by an eighth of a pixel; writes shimmer.csv.
          Likewise the light that haze scatters, drawn and traced, and what it costs; writes fog.csv.
          The names 'occlusion', 'furnace', 'lamps', 'shimmer', 'fog' and 'denoise' measure these alone.
          --no-truth: without traced images, and the decibels to them.
          --images: also the images of both.
        """;

    private static readonly RenderSettings Plain = new() { Shadows = false, AmbientOcclusion = false };

    /// <summary>Names of the columns of the table of shadows.</summary>
    public static readonly string[] Columns =
    [
        "scene", "width", "height", "facing_pixels", "wrong_percent_resting", "wrong_percent_moving", "samples_of_truth",
        "db_vertex", "db_without_shadows", "db_with_shadows", "db_with_occlusion", "frame_ms_without_shadows", "frame_ms_with_shadows",
        "frame_ms_with_occlusion", "ratio_with_shadows", "ratio_with_occlusion",
    ];

    /// <summary>Runs the command and returns the exit code.</summary>
    /// <param name="args">The words after the command's name.</param>
    public static int Run(ReadOnlySpan<string> args)
    {
        var isQuick = false;
        var hasTruth = true;
        string? output = null;
        string? images = null;
        var scenes = new List<string>();
        var parser = new CommandLineParser(Usage)
            .Flag("--quick", () => isQuick = true)
            .Flag("--no-truth", () => hasTruth = false)
            .Option("--output", value => output = value)
            .Option("--images", value => images = Directory.CreateDirectory(value).FullName)
            .Names(static name => name is "occlusion" or "furnace" or "lamps" or "shimmer" or "fog" or "denoise"
                || File.Exists(PathOf(name)), scenes);
        if (!parser.TryParse(args))
        {
            return 2;
        }

        var folder = output ?? CommandLineParser.FolderFor(isQuick);
        var tables = new Dictionary<string, Action>
        {
            ["occlusion"] = () => Write("occlusion.csv", OcclusionTable.Columns, (isQuick ? ["menger-4"] : OcclusionTable.Fractals)
                .Select(name => OcclusionTable.Measure(name, isQuick, images))),
            ["furnace"] = () => Write("furnace.csv", FurnaceTable.Columns, FurnaceTable.Measure(
                AssetLoader.Load(Path.Combine(FractalCase.Assets, "models", "sphere.obj")).Scene.Objects[0].Model.Mesh, isQuick)),
            ["lamps"] = () => Write(
                "lamps.csv", LampTable.Columns, LampTable.Swarms.Select(swarm => LampTable.Measure(swarm, isQuick, images))),
            ["shimmer"] = () => Write("shimmer.csv", ShimmerTable.Columns, ShimmerTable.Scenes.SelectMany(ShimmerTable.Measure)),
            ["fog"] = () => Write("fog.csv", FogTable.Columns, (isQuick ? FogTable.Scenes[..1] : FogTable.Scenes)
                .Select(name => FogTable.Measure(name, isQuick, images))),
            ["denoise"] = () => Write("denoise.csv", DenoiseTable.Columns, MeasureDenoising(isQuick, images)),
        };
        var named = scenes.Where(tables.ContainsKey).ToArray();
        foreach (var name in scenes.Count == 0 ? [.. tables.Keys] : named)
        {
            tables[name]();
        }

        if (scenes.Count == 0)
        {
            scenes.AddRange(isQuick ? ["menger"] : ["menger", "playground", "gallery", "inside"]);
        }
        else if (scenes.RemoveAll(name => tables.ContainsKey(name)) > 0 && scenes.Count == 0)
        {
            return 0;
        }

        Write("light.csv", Columns, scenes.Select(scene => Measure(scene, isQuick, hasTruth, images)));
        return 0;

        void Write(string file, string[] columns, IEnumerable<object?[]> rows)
        {
            var table = new TableOptions("light", isQuick, folder).CreateTable(file, columns);
            foreach (var row in rows)
            {
                table.Add(row);
                Console.WriteLine(string.Join(' ', row.Select(static field => Convert.ToString(field, CultureInfo.InvariantCulture))));
            }

            table.Save();
        }
    }

    private static IEnumerable<object?[]> MeasureDenoising(bool isQuick, string? images)
    {
        string[] scenes = isQuick ? ["menger"] : ["menger", "gallery", "inside"];
        return scenes.SelectMany(name => isQuick
            ? DenoiseTable.Measure(name, 240, 135, [4, 16, 64], 256, images)
            : DenoiseTable.Measure(name, 960, 540, [4, 16, 64, 256], 1024, images)
                // A converged image of many samples has to have many more.
                .Concat(DenoiseTable.Measure(name, 240, 135, [1024], 8192, images)));
    }

    private static string PathOf(string name) => Path.Combine(FractalCase.Assets, "scenes", name + ".sdo");

    private static object?[] Measure(string name, bool isQuick, bool hasTruth, string? images)
    {
        var (width, height) = isQuick ? (320, 180) : (1280, 720);
        var scene = AssetLoader.Load(PathOf(name)).Scene;
        var view = View.Of(scene, (double)width / height);
        var error = new ShadowError(scene, view, width, height);
        var (facing, resting) = error.Count(new());
        var (_, moving) = error.Count(new() { FitShadowsToView = false });

        // A traced image takes long: half the size shows the same.
        var (smallWidth, smallHeight, samples) = (width / 2, height / 2, !hasTruth ? 0 : isQuick ? 32 : 64);
        var tracer = new PathTracer(scene, view, smallWidth, smallHeight);
        for (var i = 0; i < samples; i++)
        {
            tracer.AddSample();
        }

        var truth = tracer.ToImage();
        if (images is not null)
        {
            truth.SavePng(Path.Combine(images, name + "-truth.png"));
        }

        var milliseconds = MeasureFrames(scene, view, isQuick ? 5 : 20);
        return
        [
            name, width, height, facing, Percent(resting, facing), Percent(moving, facing), samples,
            Decibels(new() { Shading = Shading.PerVertex }), Decibels(Plain), Decibels(Plain with { Shadows = true }), Decibels(new()),
            Math.Round(milliseconds[0], 1), Math.Round(milliseconds[1], 1), Math.Round(milliseconds[2], 1),
            Math.Round(milliseconds[1] / milliseconds[0], 3), Math.Round(milliseconds[2] / milliseconds[0], 3),
        ];

        double? Decibels(RenderSettings settings)
        {
            if (!hasTruth)
            {
                return null;
            }

            using var renderer = Renderer.Offscreen(smallWidth, smallHeight, settings);
            var image = renderer.Draw(scene, view);
            if (images is not null)
            {
                var kind = settings.Shading == Shading.PerVertex ? "vertex" : !settings.Shadows ? "plain"
                    : settings.AmbientOcclusion ? "with" : "shadows";
                image.SavePng(Path.Combine(images, $"{name}-{kind}.png"));
            }

            return Math.Round(ImageError.PeakSignalToNoiseRatio(image, truth), 2);
        }
    }

    private static double Percent(int part, int whole) => Math.Round(100.0 * part / Math.Max(1, whole), 2);

    /// <summary>Measures frames of a camera that moves, in turns: the best processor time of each kind.</summary>
    private static double[] MeasureFrames(LoadedScene scene, View view, int rounds)
    {
        var settings = new AdaptiveQuality().Adapt(new());
        var shadowsOnly = settings with { AmbientOcclusion = false };
        RenderSettings[] kinds = [shadowsOnly with { Shadows = false }, shadowsOnly, settings];
        using var context = new OffscreenContext();
        using var frame = new FrameRenderer(context);
        using var renderer = new SceneRenderer(context, DrawableScene.Prepare(scene, settings));
        var step = 1e-4 * scene.Bounds.Diagonal * Vector.I;
        double[] best = [.. kinds.Select(static _ => double.PositiveInfinity)];
        for (var round = 0; round <= rounds; round++)
        {
            var moved = view with { Camera = view.Camera with { Position = view.Camera.Position + (round * step) } };
            for (var i = 0; i < kinds.Length; i++)
            {
                var time = Time(moved, kinds[i]);
                // In the first round, programs are compiled and maps drawn.
                best[i] = round > 0 ? Math.Min(best[i], time) : best[i];
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
