using System.Globalization;
using FractalEngine.Benchmarks.Measuring;
using FractalEngine.Core.Images;
using FractalEngine.Render;
using FractalEngine.Render.Preparation;
using FractalEngine.Render.Views;
using FractalEngine.Render.Windowing;

namespace FractalEngine.Benchmarks.Drawing;

/// <summary>
/// What does a frame cost with all culling, and with every instance? How far are both from the reference, which has every instance and 36
/// samples a pixel? All is measured in one run, since only ratios mean anything.
/// </summary>
/// <param name="rounds">Number of rounds, the best of which counts.</param>
/// <param name="samples">Samples a pixel.</param>
/// <param name="withTruth">True to draw the reference too.</param>
/// <param name="output">Receives the rows as text.</param>
/// <param name="table">Receives the rows too, unless it is null.</param>
internal sealed class FrameTable(int rounds, int samples, bool withTruth, TextWriter output, CsvTable? table)
{
    /// <summary>Names of the table's columns.</summary>
    public static readonly string[] Columns =
        ["frame", "drawn", "instances", "ms", "culling_ms", "to_every_instance_db", "to_the_truth_db", "slowest_ms"];

    private const int Supersampling = 6;
    private const int InstanceBudget = 20_000_000;

    private int _drawCount;

    /// <summary>Writes a block of rows for each frame.</summary>
    public void Write(IEnumerable<FrameCase> cases)
    {
        WriteLine($"{FrameCase.Width}x{FrameCase.Height}, {samples} samples a pixel, best of {rounds}");
        output.WriteLine(
            "frame                            drawn                 instances        ms   share  to every  to truth   culling ms");
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
        // Instances have ambient occlusion only where they are culled, which would tell the images apart.
        var settings = new RenderSettings { Samples = samples, Shadows = false, AmbientOcclusion = false };
        var reference = DrawEveryInstance(frameCase, context, frame, settings);
        using var renderer = new SceneRenderer(context, DrawableScene.Prepare(frameCase.Scene, settings));
        foreach (var (name, variant) in CreateVariants(settings))
        {
            var time = MeasureAfterWarmUp(() => DrawPerturbed(frame, renderer, frameCase, variant));
            var image = frame.Capture();
            var instanceCount = renderer.Statistics.InstanceCount;
            var cullingTime = MeasureAfterWarmUp(
                () => renderer.Cull(frameCase.PerturbedView(++_drawCount), FrameCase.Width, FrameCase.Height, variant));
            AddRow(frameCase.Name, name, instanceCount, time, cullingTime, image, reference);
        }

        // Nothing has changed: only what is on the GPU already is drawn.
        var unchangedTime = MeasureAfterWarmUp(() =>
        {
            frame.Draw(renderer, frameCase.View, FrameCase.Width, FrameCase.Height, settings);
            frame.Finish();
        });
        AddRow(frameCase.Name, "kept", renderer.Statistics.InstanceCount, unchangedTime, 0, null, reference);
        AddFlight(frameCase.Name, CameraFlight.Measure(frame, renderer, frameCase, new() { Samples = samples }));
    }

    private static (string Name, RenderSettings Settings)[] CreateVariants(RenderSettings settings)
    {
        var culling = settings.Culling! with { InstanceBudget = InstanceBudget };
        return
        [
            ("detail", settings with { Culling = culling }),
            ("- occlusion-culling", settings with { Culling = culling with { OcclusionCulling = false } }),
            ("- frustum-culling", settings with { Culling = culling with { FrustumCulling = false } }),
            ("- backface-culling", settings with { Culling = culling, BackFaceCulling = false }),
            ("- threads", settings with { Culling = culling with { ThreadCount = 1 } }),
            ("- size", settings with { Culling = culling with { MinProjectedSize = 0 } }),
            ("3 pixels", settings with { Culling = culling with { MinProjectedSize = 3 } }),
        ];
    }

    /// <summary>Draws every instance and adds its row, where the instances are not too many.</summary>
    private Reference DrawEveryInstance(FrameCase frameCase, OffscreenContext context, FrameRenderer frame, RenderSettings settings)
    {
        var all = settings with { Culling = null, InstanceBudget = InstanceBudget };
        var prepared = DrawableScene.Prepare(frameCase.Scene, all);
        if (prepared.Notices.Length > 0)
        {
            WriteLine($"{frameCase.Name,-32} every instance        {prepared.Notices[0]}");
            return new(null, null, double.NaN);
        }

        using var renderer = new SceneRenderer(context, prepared);
        var time = MeasureAfterWarmUp(() => DrawPerturbed(frame, renderer, frameCase, all));
        var image = frame.Capture();
        PixelImage? truth = null;
        if (withTruth)
        {
            frame.Draw(renderer, frameCase.View, Supersampling * FrameCase.Width, Supersampling * FrameCase.Height,
                all with { Samples = 0 });
            truth = ImageError.Downsample(frame.Capture(), Supersampling);
        }

        AddRow(frameCase.Name, "every instance", prepared.InstanceCount, time, 0, image, new(null, truth, time));
        return new(image, truth, time);
    }

    /// <summary>Measures the best milliseconds of some rounds, after a call that does not count.</summary>
    private double MeasureAfterWarmUp(Action action)
    {
        action();
        return InterleavedTiming.MeasureBestMilliseconds(action, rounds);
    }

    private void DrawPerturbed(FrameRenderer frame, SceneRenderer renderer, FrameCase frameCase, RenderSettings settings)
    {
        frame.Draw(renderer, frameCase.PerturbedView(++_drawCount), FrameCase.Width, FrameCase.Height, settings);
        frame.Finish();
    }

    private void AddRow(
        string name, string drawn, long instances, double time, double cullingTime, PixelImage? image, Reference reference)
    {
        var toEveryInstance = PeakSignalToNoiseRatio(image, reference.EveryInstance);
        var toTruth = PeakSignalToNoiseRatio(image, reference.Truth);
        var share = double.IsNaN(reference.Time) ? "-" : FormattableString.Invariant($"1/{reference.Time / time:F1}");
        var row = FormattableString.Invariant($"{name,-32} {drawn,-19} {instances,11} {time,9:F1} {share,7}");
        WriteLine($"{row} {FormatDecibels(toEveryInstance),9} {FormatDecibels(toTruth),9} {cullingTime,12:F1}");
        output.Flush();
        double? roundedCullingTime = cullingTime > 0 ? Math.Round(cullingTime, 3) : null;
        table?.Add(
            name, drawn, instances, Math.Round(time, 3), roundedCullingTime, RoundDecibels(toEveryInstance), RoundDecibels(toTruth), null);
    }

    private void AddFlight(string name, CameraFlight flight)
    {
        var meanMilliseconds = 1000 * flight.Seconds / flight.FrameCount;
        var row = FormattableString.Invariant($"{name,-32} {"flight",-19} {flight.MeanInstanceCount,11} {meanMilliseconds,9:F1}");
        var rate = flight.FrameCount / flight.Seconds;
        WriteLine($"{row}  {rate:F1} frames a second, the slowest {flight.SlowestMilliseconds:F0} ms");
        table?.Add(
            name, "flight", flight.MeanInstanceCount, Math.Round(meanMilliseconds, 3), null, null, null,
            Math.Round(flight.SlowestMilliseconds, 1));
    }

    private void WriteLine(FormattableString text) => output.WriteLine(text.ToString(CultureInfo.InvariantCulture));

    private static double PeakSignalToNoiseRatio(PixelImage? image, PixelImage? reference) =>
        image is null || reference is null ? double.NaN : ImageError.PeakSignalToNoiseRatio(image, reference);

    private static double? RoundDecibels(double ratio) => double.IsFinite(ratio) ? Math.Round(ratio, 2) : null;

    private static string FormatDecibels(double ratio) => double.IsNaN(ratio) ? "-" : FormattableString.Invariant($"{ratio:F1} dB");

    /// <summary>What all variants of a frame are compared with.</summary>
    /// <param name="EveryInstance">Image of every instance, or null where the instances are too many.</param>
    /// <param name="Truth">The same with 36 samples a pixel, or null where it is not drawn.</param>
    /// <param name="Time">Time of the first in milliseconds, NaN where there is none.</param>
    private readonly record struct Reference(PixelImage? EveryInstance, PixelImage? Truth, double Time);
}
