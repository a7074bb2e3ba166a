using System.Diagnostics;
using System.Globalization;
using FractalEngine.Benchmarks.Measuring;
using FractalEngine.Core.Images;
using FractalEngine.Core.Maths;
using FractalEngine.Render;
using FractalEngine.Render.Preparation;
using FractalEngine.Render.Windowing;

namespace FractalEngine.Benchmarks.Drawing;

/// <summary>
/// What a picture costs with everything left out that is not seen, beside drawing every instance, and how far both are from the truth: the
/// same with 36 samples a pixel. All in one run, since only ratios mean anything.
/// </summary>
/// <param name="rounds">Of which the best counts.</param>
/// <param name="samples">A pixel.</param>
/// <param name="withTruth">Whether every instance is also drawn with many samples.</param>
/// <param name="output">Receives the rows as text.</param>
/// <param name="table">Receives them too, if there is one.</param>
internal sealed class FrameTable(int rounds, int samples, bool withTruth, TextWriter output, CsvTable? table)
{
    /// <summary>Names of the columns.</summary>
    public static readonly string[] Columns = ["picture", "drawn", "instances", "ms", "choosing_ms", "to_every_instance_db",
        "to_the_truth_db", "slowest_ms"];

    private const int Width = 1280;
    private const int Height = 720;
    private const int Supersampling = 6;

    // Less than a thousandth of a pixel, but another view: nothing may be kept from the picture before.
    private const double CameraPerturbation = 1e-9;

    /// <summary>Writes a block of rows for each picture.</summary>
    public void Write(IEnumerable<FrameCase> cases)
    {
        output.WriteLine(string.Create(CultureInfo.InvariantCulture, $"{Width}x{Height}, {samples} samples a pixel, best of {rounds}"));
        output.WriteLine(
            "picture                          drawn             instances        ms   share   to brute   to truth  choosing ms");
        foreach (var frameCase in cases)
        {
            using var context = new OffscreenContext();
            table?.GraphicsDriver = context.DriverName;
            using var frame = new FrameRenderer(context);
            Write(frameCase, context, frame);
        }
    }

    private void Write(FrameCase frameCase, OffscreenContext context, FrameRenderer frame)
    {
        var settings = new RenderSettings { Samples = samples };
        var (everyInstance, truth, everyInstanceTime) = DrawEveryInstance(frameCase, context, frame, settings);
        using var renderer = new SceneRenderer(context, DrawableScene.Prepare(frameCase.Scene, settings));
        var detail = settings.Culling! with { InstanceBudget = 20_000_000 };
        (string Name, RenderSettings Settings)[] variants =
        [
            ("detail", settings with { Culling = detail }),
            ("- hidden", settings with { Culling = detail with { OcclusionCulling = false } }),
            ("- outside", settings with { Culling = detail with { FrustumCulling = false } }),
            ("- backs", settings with { Culling = detail, BackFaceCulling = false }),
            ("- threads", settings with { Culling = detail with { ThreadCount = 1 } }),
            ("- size", settings with { Culling = detail with { MinProjectedSize = 0 } }),
            ("3 pixels", settings with { Culling = detail with { MinProjectedSize = 3 } }),
        ];
        foreach (var (name, variant) in variants)
        {
            var time = MeasureBest(() => DrawPerturbed(frame, renderer, frameCase, variant));
            var image = frame.Capture();
            var statistics = renderer.Statistics;
            AddRow(frameCase.Name, name, statistics.InstanceCount, time, everyInstanceTime, everyInstance, truth, image,
                MeasureCulling(renderer, frameCase, variant));
        }

        // Nothing has changed: only what is on the GPU already is drawn.
        var unchangedTime = MeasureBest(() =>
        {
            frame.Draw(renderer, frameCase.View, Width, Height, settings);
            frame.Finish();
        });
        AddRow(frameCase.Name, "kept", renderer.Statistics.InstanceCount, unchangedTime, everyInstanceTime, null, null, null, 0);
        var flight = CameraFlight.Measure(frame, renderer, frameCase, settings, (Width, Height));
        output.WriteLine(string.Create(
            CultureInfo.InvariantCulture,
            $"{frameCase.Name,-32} {"flight",-15} {flight.MeanInstanceCount,11} {1000 * flight.Seconds / flight.FrameCount,9:F1}  {flight.FrameCount / flight.Seconds:F1} pictures a second, the slowest {flight.SlowestMilliseconds:F0} ms"));
        table?.Add(
            frameCase.Name, "flight", flight.MeanInstanceCount, Math.Round(1000 * flight.Seconds / flight.FrameCount, 3), null, null, null,
            Math.Round(flight.SlowestMilliseconds, 1));
    }

    private (PixelImage? Brute, PixelImage? Truth, double Time) DrawEveryInstance(FrameCase frameCase, OffscreenContext context,
        FrameRenderer frame,
        RenderSettings settings)
    {
        var all = settings with { Culling = null, InstanceBudget = 20_000_000 };
        var prepared = DrawableScene.Prepare(frameCase.Scene, all);
        if (prepared.Notices.Length > 0)
        {
            output.WriteLine(string.Create(CultureInfo.InvariantCulture, $"{frameCase.Name,-32} every instance    {prepared.Notices[0]}"));
            return (null, null, double.NaN);
        }

        using var renderer = new SceneRenderer(context, prepared);
        var time = MeasureBest(() => DrawPerturbed(frame, renderer, frameCase, all));
        var image = frame.Capture();
        PixelImage? truth = null;
        if (withTruth)
        {
            frame.Draw(renderer, frameCase.View, Supersampling * Width, Supersampling * Height, all with { Samples = 0 });
            truth = ImageError.Downsample(frame.Capture(), Supersampling);
        }

        AddRow(frameCase.Name, "every instance", prepared.InstanceCount, time, time, null, truth, image, 0);
        return (image, truth, time);
    }

    private double MeasureBest(Action draw)
    {
        draw();
        var best = double.PositiveInfinity;
        for (var round = 0; round < rounds; round++)
        {
            var watch = Stopwatch.StartNew();
            draw();
            best = Math.Min(best, watch.Elapsed.TotalMilliseconds);
        }

        return best;
    }

    private int _drawCount;

    private void DrawPerturbed(FrameRenderer frame, SceneRenderer renderer, FrameCase frameCase, RenderSettings settings)
    {
        var camera = frameCase.View.Camera;
        var moved =
            frameCase.View with { Camera =
            camera with { Position = camera.Position + (CameraPerturbation * (++_drawCount % 2) * Vector.One) } };
        frame.Draw(renderer, moved, Width, Height, settings);
        frame.Finish();
    }

    /// <summary>The time that choosing takes, without any drawing.</summary>
    private double MeasureCulling(SceneRenderer renderer, FrameCase frameCase, RenderSettings settings) =>
        MeasureBest(() => renderer.Cull(
            frameCase.View with { Camera =
            frameCase.View.Camera with { Position = frameCase.View.Camera.Position
                + (CameraPerturbation * (++_drawCount % 2) * Vector.One) } }, Width, Height,
            settings));

    private void AddRow(
        string name, string drawn, long instances, double time, double everyInstanceTime, PixelImage? everyInstance, PixelImage? truth,
        PixelImage? image, double cullingTime)
    {
        var toEveryInstance = image is null || everyInstance is null ? double.NaN : ImageError.PeakSignalToNoiseRatio(image, everyInstance);
        var toTruth = image is null || truth is null ? double.NaN : ImageError.PeakSignalToNoiseRatio(image, truth);
        output.WriteLine(string.Create(
            CultureInfo.InvariantCulture,
            $"{name,-32} {drawn,-15} {instances,11} {time,9:F1}  {(double.IsNaN(everyInstanceTime) ? "     -" : $"1/{everyInstanceTime / time:F1}"),6} {FormatDecibels(toEveryInstance),10} {FormatDecibels(toTruth),10} {cullingTime,12:F1}"));
        output.Flush();
        table?.Add(name, drawn, instances, Math.Round(time, 3), cullingTime > 0
            ? Math.Round(cullingTime, 3)
            : null, RoundDecibels(toEveryInstance),
            RoundDecibels(toTruth), null);
    }

    private static double? RoundDecibels(double ratio) => double.IsFinite(ratio) ? Math.Round(ratio, 2) : null;

    private static string FormatDecibels(double ratio) =>
        double.IsNaN(ratio) ? "-" : string.Create(CultureInfo.InvariantCulture, $"{ratio:F1} dB");
}
