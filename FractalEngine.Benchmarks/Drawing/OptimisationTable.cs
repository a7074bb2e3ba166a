using System.Diagnostics;
using System.Globalization;
using FractalEngine.Benchmarks.Measuring;
using FractalEngine.Core.Maths;
using FractalEngine.Parsing.Assets;
using FractalEngine.Render;
using FractalEngine.Render.Preparation;
using FractalEngine.Render.Windowing;

namespace FractalEngine.Benchmarks.Drawing;

/// <summary>
/// What each thing that is skipped saves: all skips on, beside each switched off alone, in turn within one run, and how far its picture is
/// from the first.
/// </summary>
/// <param name="rounds">Of which the best counts.</param>
/// <param name="output">Receives the rows as text.</param>
/// <param name="table">Receives them too, if there is one.</param>
internal sealed class OptimisationTable(int rounds, TextWriter output, CsvTable? table)
{
    /// <summary>Names of the columns.</summary>
    public static readonly string[] Columns = ["scene", "switched_off", "start_ms", "moving_ms", "standing_ms", "allocated_bytes",
        "to_the_first_db", "counter", "count_with_all_skips", "count"];

    private const int Width = 1280;
    private const int Height = 720;
    private const double Aspect = (double)Width / Height;
    private const int MovingFrames = 5;
    private const int StillFrames = 3;

    // Of the scene's size, between two pictures while moving.
    private const double CameraStep = 2e-4;

    /// <summary>Writes a block of rows for a scene.</summary>
    /// <param name="path">Its file.</param>
    public void Write(string path)
    {
        using var context = new OffscreenContext();
        table?.GraphicsDriver = context.DriverName;
        using var frame = new FrameRenderer(context);
        var cases = OptimisationCase.All;
        // What is measured first would pay for the compiler.
        Measure(path, cases[0], context, frame);
        var best = new OptimisationSample?[cases.Count];
        for (var round = 0; round < rounds; round++)
        {
            for (var i = 0; i < cases.Count; i++)
            {
                best[i] = Measure(path, cases[i], context, frame).BestWith(best[i]);
            }
        }

        output.WriteLine(string.Create(CultureInfo.InvariantCulture, $"{Path.GetFileName(path)}, {Width}x{Height}, best of {rounds}"));
        output.WriteLine("                      start ms  moving ms  standing ms       MB   to the first  counted");
        for (var i = 0; i < cases.Count; i++)
        {
            AddRow(Path.GetFileNameWithoutExtension(path), cases[i], best[i]!, best[0]!);
        }

        output.WriteLine();
        output.Flush();
    }

    private static OptimisationSample Measure(string path, OptimisationCase optimisation, OffscreenContext context, FrameRenderer frame)
    {
        GC.Collect();
        var bytes = GC.GetTotalAllocatedBytes(precise: true);
        var watch = Stopwatch.StartNew();
        var file = AssetLoader.Load(path, optimisation.Load);
        var view = View.Of(file.Scene, Aspect);
        var preparation = new ScenePreparation(file.Scene, optimisation.Settings);
        if (optimisation.Settings.LazyLoading)
        {
            preparation.PrepareVisible(view, Aspect);
        }
        else
        {
            preparation.PrepareAll(null, CancellationToken.None);
        }

        using var renderer = new SceneRenderer(context, preparation.Scene);
        Draw(view);
        var start = watch.Elapsed.TotalMilliseconds;
        bytes = GC.GetTotalAllocatedBytes(precise: true) - bytes;
        var step = CameraStep * file.Scene.Bounds.Diagonal * Vector.I;
        var movingTime =
            MeasureBest(MovingFrames,
            i => Draw(view with { Camera = view.Camera with { Position = view.Camera.Position + ((i + 1) * step) } }));
        Draw(view);
        var stillTime = MeasureBest(StillFrames, _ => Draw(view));
        return new(start, movingTime, stillTime, bytes, renderer.Statistics, frame.Capture());

        void Draw(View drawnView)
        {
            frame.Draw(renderer, drawnView, Width, Height, optimisation.Settings);
            frame.Finish();
        }
    }

    private static double MeasureBest(int count, Action<int> draw)
    {
        var best = double.PositiveInfinity;
        for (var i = 0; i < count; i++)
        {
            var watch = Stopwatch.StartNew();
            draw(i);
            best = Math.Min(best, watch.Elapsed.TotalMilliseconds);
        }

        return best;
    }

    private void AddRow(string scene, OptimisationCase optimisation, OptimisationSample sample, OptimisationSample first)
    {
        var ratio = ImageError.PeakSignalToNoiseRatio(sample.StillImage, first.StillImage);
        var distance = double.IsPositiveInfinity(ratio) ? "the same" : string.Create(CultureInfo.InvariantCulture, $"{ratio:F1} dB");
        var counted = optimisation.Unit.Length == 0
            ? ""
            : string.Create(CultureInfo.InvariantCulture,
            $"{optimisation.Unit}: {optimisation.CounterOf(first):N0}, now {optimisation.CounterOf(sample):N0}");
        output.WriteLine(string.Create(
            CultureInfo.InvariantCulture,
            $"{optimisation.Name,-20} {sample.StartMilliseconds,9:F1} {sample.MovingMilliseconds,10:F2} {sample.StillMilliseconds,12:F2} {sample.AllocatedBytes / 1e6,8:F1} {distance,14}  {counted}"));
        var isCounted = optimisation.Unit.Length > 0;
        table?.Add(
            scene, isCounted ? optimisation.Name[2..] : "nothing", Math.Round(sample.StartMilliseconds, 3),
            Math.Round(sample.MovingMilliseconds, 3),
            Math.Round(sample.StillMilliseconds, 3), sample.AllocatedBytes,
            double.IsPositiveInfinity(ratio) ? null : Math.Round(ratio, 2), isCounted ? optimisation.Unit : null, isCounted
            ? optimisation.CounterOf(first)
            : null, isCounted ? optimisation.CounterOf(sample) : null);
    }
}
