using System.Diagnostics;
using System.Globalization;
using FractalEngine.Benchmarks.Drawing;
using FractalEngine.Benchmarks.Measuring;
using FractalEngine.Core.Images;
using FractalEngine.Parsing.Assets;
using FractalEngine.Render;
using FractalEngine.Render.Tracing;
using FractalEngine.Render.Views;

namespace FractalEngine.Benchmarks.Rays;

/// <summary>Runs the command <c>trace</c>: what a sample of a traced image costs, and how fast the image converges.</summary>
internal static class TraceCommand
{
    private const string Usage = """
        trace [SCENE...] [--quick] [--output FOLDER]
          Milliseconds of a sample at 960x540 on all cores, with one bounce and with all, beside those of a drawn frame,
          and how close the image is after 5 and 10 seconds to one of many samples; writes trace.csv. Scenes: menger,
          gallery, playground, inside; all unless stated, which takes about half an hour.
        """;

    private static readonly string[] Scenes = ["menger", "gallery", "playground", "inside"];

    /// <summary>Runs the command and returns the exit code.</summary>
    /// <param name="args">The words after the command's name.</param>
    public static int Run(ReadOnlySpan<string> args)
    {
        var isQuick = false;
        string? output = null;
        var names = new List<string>();
        var parser = new CommandLineParser(Usage)
            .Flag("--quick", () => isQuick = true)
            .Option("--output", value => output = value)
            .Names(name => Scenes.Contains(name) && !names.Contains(name), names);
        if (!parser.TryParse(args))
        {
            return 2;
        }

        var table = new CsvTable(
            Path.Combine(output ?? CommandLineParser.FolderFor(isQuick), "trace.csv"),
            string.Join(' ', ["trace", .. names, .. isQuick ? ["--quick"] : Array.Empty<string>()]),
            "scene", "width", "height", "sample_ms_one_bounce", "sample_ms", "drawn_frame_ms", "samples_of_truth", "db_after_5_s",
            "db_after_10_s");
        var (width, height) = isQuick ? (160, 90) : (960, 540);
        var truthSamples = isQuick ? 64 : 1024;
        foreach (var name in names.Count > 0 ? names.ToArray() : isQuick ? Scenes[..1] : Scenes)
        {
            var scene = AssetLoader.Load(Path.Combine(FractalCase.Assets, "scenes", name + ".sdo")).Scene;
            var view = View.Of(scene, (double)width / height);
            var (after5, after10, sampleMilliseconds) = Converge(new PathTracer(scene, view, width, height, seed: 1));
            var oneBounce = new PathTracer(scene, view, width, height) { BounceLimit = 1 };
            var oneBounceMilliseconds = InterleavedTiming.MeasureBestMilliseconds(() => oneBounce.AddSample(), 8);
            var truth = new PathTracer(scene, view, width, height, seed: 2);
            for (var i = 0; i < truthSamples; i++)
            {
                truth.AddSample();
            }

            using var renderer = Renderer.Offscreen(width, height);
            renderer.Draw(scene);
            var drawn = InterleavedTiming.MeasureBestMilliseconds(() => renderer.Draw(scene), 5);
            var image = truth.ToImage();
            object[] row =
            [
                name, width, height, Math.Round(oneBounceMilliseconds, 1),
                Math.Round(sampleMilliseconds, 1), Math.Round(drawn, 1), truthSamples,
                Math.Round(ImageError.PeakSignalToNoiseRatio(after5, image), 2),
                Math.Round(ImageError.PeakSignalToNoiseRatio(after10, image), 2),
            ];
            table.Add(row);
            Console.WriteLine(string.Join(' ', row.Select(static field => Convert.ToString(field, CultureInfo.InvariantCulture))));
        }

        table.Save();
        return 0;
    }

    /// <summary>Adds samples for ten seconds.</summary>
    private static (PixelImage After5, PixelImage After10, double SampleMilliseconds) Converge(PathTracer tracer)
    {
        // Compiled before the clock starts.
        tracer.AddSample();
        var clock = Stopwatch.StartNew();
        PixelImage? after5 = null;
        var best = double.PositiveInfinity;
        while (clock.Elapsed.TotalSeconds < 10)
        {
            var start = clock.Elapsed;
            tracer.AddSample();
            best = Math.Min(best, (clock.Elapsed - start).TotalMilliseconds);
            after5 = after5 is null && clock.Elapsed.TotalSeconds >= 5 ? tracer.ToImage() : after5;
        }

        return (after5 ?? tracer.ToImage(), tracer.ToImage(), best);
    }
}
