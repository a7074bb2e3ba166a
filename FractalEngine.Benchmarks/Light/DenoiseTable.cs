using FractalEngine.Benchmarks.Drawing;
using FractalEngine.Benchmarks.Measuring;
using FractalEngine.Core.Images;
using FractalEngine.Parsing.Assets;
using FractalEngine.Render.Images;
using FractalEngine.Render.Tracing;
using FractalEngine.Render.Views;

namespace FractalEngine.Benchmarks.Light;

/// <summary>
/// How much closer to a converged image does the denoiser bring one of few samples, and what does it cost? Whole images are compared, and
/// of the sponge a part that is full of holes of a few pixels.
/// </summary>
internal static class DenoiseTable
{
    /// <summary>Names of the table's columns.</summary>
    public static readonly string[] Columns =
    [
        "scene", "part", "width", "height", "samples", "samples_of_truth", "db", "db_denoised", "gain_db", "filter_processor_s",
        "trace_processor_s",
    ];

    /// <summary>Traces a scene, and measures its image after several numbers of samples.</summary>
    /// <param name="name">Name of the scene.</param>
    /// <param name="width">Width of the image in pixels.</param>
    /// <param name="height">Height of the image in pixels.</param>
    /// <param name="counts">Numbers of samples, ascending.</param>
    /// <param name="truthCount">Number of samples of the image that counts as right, with other noise.</param>
    /// <param name="images">Folder for the images; null for none.</param>
    /// <returns>A row for each number, and each part of the image.</returns>
    public static IEnumerable<object?[]> Measure(string name, int width, int height, int[] counts, int truthCount, string? images)
    {
        var scene = AssetLoader.Load(Path.Combine(FractalCase.Assets, "scenes", name + ".sdo")).Scene;
        var view = View.Of(scene, (double)width / height);
        var truthTracer = new PathTracer(scene, view, width, height, seed: 2);
        for (var i = 0; i < truthCount; i++)
        {
            truthTracer.AddSample();
        }

        var truth = truthTracer.ToImage();
        var tracer = new PathTracer(scene, view, width, height, seed: 1) { CanDenoise = true };
        // Compiled before the clock starts.
        tracer.AddSample();
        tracer.Denoise();
        var traced = 0.0;
        foreach (var count in counts)
        {
            traced += Time(() =>
            {
                while (tracer.SampleCount < count)
                {
                    tracer.AddSample();
                }
            });
            var raw = tracer.ToImage();
            var denoised = raw;
            var filtered = Time(() => denoised = tracer.Denoise());
            if (images is not null)
            {
                raw.SavePng(Path.Combine(images, $"{name}-{count}.png"));
                denoised.SavePng(Path.Combine(images, $"{name}-{count}-denoised.png"));
            }

            foreach (var part in name == "menger" ? new[] { "whole", "holes" } : ["whole"])
            {
                var before = ImageError.PeakSignalToNoiseRatio(Part(raw, part), Part(truth, part));
                var after = ImageError.PeakSignalToNoiseRatio(Part(denoised, part), Part(truth, part));
                yield return
                [
                    name, part, width, height, count, truthCount,
                    Math.Round(before, 2), Math.Round(after, 2), Math.Round(after - before, 2), Math.Round(filtered, 2),
                    Math.Round(traced, 1),
                ];
            }
        }
    }

    /// <summary>Processor time of all threads, in seconds.</summary>
    private static double Time(Action run)
    {
        var before = Environment.CpuUsage.TotalTime;
        run();
        return (Environment.CpuUsage.TotalTime - before).TotalSeconds;
    }

    /// <summary>Cuts out the part of the sponge's far face, whose holes have a few pixels.</summary>
    private static PixelImage Part(PixelImage image, string part)
    {
        if (part == "whole")
        {
            return image;
        }

        var (left, top, width, height) = (image.Width * 5 / 8, image.Height * 5 / 18, image.Width / 6, image.Height * 2 / 9);
        return new(width, height,
        [
            .. Enumerable.Range(top, height).SelectMany(y => image.Pixels.AsSpan(4 * ((y * image.Width) + left), 4 * width).ToArray()),
        ]);
    }
}
