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
    private const double Step = 1e-9;

    /// <summary>Writes a block of rows for each picture.</summary>
    public void Write(IEnumerable<FrameCase> cases)
    {
        output.WriteLine(string.Create(CultureInfo.InvariantCulture, $"{Width}x{Height}, {samples} samples a pixel, best of {rounds}"));
        output.WriteLine(
            "picture                          drawn             instances        ms   share   to brute   to truth  choosing ms");
        foreach (var item in cases)
        {
            using var context = new OffscreenContext();
            table?.Driver = context.DriverName;
            using var frame = new FrameRenderer(context);
            Write(item, context, frame);
        }
    }

    private void Write(FrameCase item, OffscreenContext context, FrameRenderer frame)
    {
        var settings = new RenderSettings { Samples = samples };
        var (brute, truth, bruteTime) = Brute(item, context, frame, settings);
        using var renderer = new SceneRenderer(context, DrawableScene.Prepare(item.Scene, settings));
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
        foreach (var (name, chosen) in variants)
        {
            var time = Time(() => Draw(frame, renderer, item, chosen));
            var picture = frame.Capture();
            var statistics = renderer.Statistics;
            Row(item.Name, name, statistics.InstanceCount, time, bruteTime, brute, truth, picture, Choosing(renderer, item, chosen));
        }

        // Nothing has changed: only what is on the GPU already is drawn.
        var still = Time(() =>
        {
            frame.Draw(renderer, item.View, Width, Height, settings);
            frame.Finish();
        });
        Row(item.Name, "kept", renderer.Statistics.InstanceCount, still, bruteTime, null, null, null, 0);
        var flight = Flight.Of(frame, renderer, item, settings, (Width, Height));
        output.WriteLine(string.Create(
            CultureInfo.InvariantCulture,
            $"{item.Name,-32} {"flight",-15} {flight.Instances,11} {1000 * flight.Seconds / flight.Pictures,9:F1}  {flight.Pictures / flight.Seconds:F1} pictures a second, the slowest {flight.Slowest:F0} ms"));
        table?.Add(
            item.Name, "flight", flight.Instances, Math.Round(1000 * flight.Seconds / flight.Pictures, 3), null, null, null,
            Math.Round(flight.Slowest, 1));
    }

    private (PixelImage? Brute, PixelImage? Truth, double Time) Brute(FrameCase item, OffscreenContext context, FrameRenderer frame,
        RenderSettings settings)
    {
        var all = settings with { Culling = null, InstanceBudget = 20_000_000 };
        var prepared = DrawableScene.Prepare(item.Scene, all);
        if (prepared.Notices.Length > 0)
        {
            output.WriteLine(string.Create(CultureInfo.InvariantCulture, $"{item.Name,-32} every instance    {prepared.Notices[0]}"));
            return (null, null, double.NaN);
        }

        using var renderer = new SceneRenderer(context, prepared);
        var time = Time(() => Draw(frame, renderer, item, all));
        var picture = frame.Capture();
        PixelImage? truth = null;
        if (withTruth)
        {
            frame.Draw(renderer, item.View, Supersampling * Width, Supersampling * Height, all with { Samples = 0 });
            truth = PictureError.Shrunk(frame.Capture(), Supersampling);
        }

        Row(item.Name, "every instance", prepared.InstanceCount, time, time, null, truth, picture, 0);
        return (picture, truth, time);
    }

    private double Time(Action draw)
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

    private int _step;

    private void Draw(FrameRenderer frame, SceneRenderer renderer, FrameCase item, RenderSettings settings)
    {
        var camera = item.View.Camera;
        var moved = item.View with { Camera = camera with { Position = camera.Position + (Step * (++_step % 2) * Vector.One) } };
        frame.Draw(renderer, moved, Width, Height, settings);
        frame.Finish();
    }

    /// <summary>The time that choosing takes, without any drawing.</summary>
    private double Choosing(SceneRenderer renderer, FrameCase item, RenderSettings settings) =>
        Time(() => renderer.Cull(
            item.View with { Camera =
            item.View.Camera with { Position = item.View.Camera.Position + (Step * (++_step % 2) * Vector.One) } }, Width, Height,
            settings));

    private void Row(
        string name, string drawn, long instances, double time, double brute, PixelImage? bruteImage, PixelImage? truth,
        PixelImage? picture, double choosing)
    {
        var toBrute = picture is null || bruteImage is null ? double.NaN : PictureError.Ratio(picture, bruteImage);
        var toTruth = picture is null || truth is null ? double.NaN : PictureError.Ratio(picture, truth);
        output.WriteLine(string.Create(
            CultureInfo.InvariantCulture,
            $"{name,-32} {drawn,-15} {instances,11} {time,9:F1}  {(double.IsNaN(brute) ? "     -" : $"1/{brute / time:F1}"),6} {Decibels(toBrute),10} {Decibels(toTruth),10} {choosing,12:F1}"));
        output.Flush();
        table?.Add(name, drawn, instances, Math.Round(time, 3), choosing > 0 ? Math.Round(choosing, 3) : null, Rounded(toBrute),
            Rounded(toTruth), null);
    }

    private static double? Rounded(double ratio) => double.IsFinite(ratio) ? Math.Round(ratio, 2) : null;

    private static string Decibels(double ratio) =>
        double.IsNaN(ratio) ? "-" : string.Create(CultureInfo.InvariantCulture, $"{ratio:F1} dB");
}
