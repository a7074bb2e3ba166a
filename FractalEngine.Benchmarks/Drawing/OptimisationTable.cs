using System.Diagnostics;
using System.Globalization;
using FractalEngine.Benchmarks.Measuring;
using FractalEngine.Core.Images;
using FractalEngine.Core.Maths;
using FractalEngine.Parsing.Assets;
using FractalEngine.Render;
using FractalEngine.Render.Images;
using FractalEngine.Render.Preparation;
using FractalEngine.Render.Views;
using FractalEngine.Render.Windowing;

namespace FractalEngine.Benchmarks.Drawing;

/// <summary>
/// What does each optimisation save? All are on at first, then each is switched off alone, in turn within one run. Each image is compared
/// with the first.
/// </summary>
/// <param name="rounds">Number of rounds, the best of which counts.</param>
/// <param name="output">Receives the rows as text.</param>
/// <param name="table">Receives the rows too, unless it is null.</param>
/// <param name="images">Folder that receives the images; null for none.</param>
internal sealed class OptimisationTable(int rounds, TextWriter output, CsvTable? table, string? images)
{
    /// <summary>Names of the table's columns.</summary>
    public static readonly string[] Columns =
    [
        "scene", "switched_off", "start_ms", "moving_ms", "standing_ms", "allocated_bytes", "to_the_first_db", "instance_budget",
        "counter", "count_with_all_skips", "count",
    ];

    private const int MovingFrames = 5;
    private const int StillFrames = 3;

    // By how much differences are larger in their image than they are.
    private const int DifferenceFactor = 8;

    // Step of the camera between two moving frames, as a fraction of the scene's size.
    private const double CameraStep = 2e-4;

    /// <summary>Writes a block of rows for a scene.</summary>
    /// <param name="path">Path of the scene's file.</param>
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

        WriteLine($"{Path.GetFileName(path)}, {FrameCase.Width}x{FrameCase.Height}, best of {rounds}");
        output.WriteLine("                      start ms  moving ms     still ms       MB   to the first  counted");
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
        var bytesBefore = GC.GetTotalAllocatedBytes(precise: true);
        var watch = Stopwatch.StartNew();
        var file = AssetLoader.Load(path, optimisation.Load);
        var view = View.Of(file.Scene, FrameCase.Aspect);
        var preparation = new ScenePreparation(file.Scene, optimisation.Settings);
        if (optimisation.Settings.LazyLoading)
        {
            preparation.PrepareVisible(view, FrameCase.Aspect);
        }
        else
        {
            preparation.PrepareAll(null, CancellationToken.None);
        }

        if (preparation.HasUnbakedSky(optimisation.Settings))
        {
            preparation.BakeSky(CancellationToken.None);
        }

        using var renderer = new SceneRenderer(context, preparation.Scene);
        Draw(view);
        var start = watch.Elapsed.TotalMilliseconds;
        var bytes = GC.GetTotalAllocatedBytes(precise: true) - bytesBefore;
        var step = CameraStep * file.Scene.Bounds.Diagonal * Vector.I;
        var drawCount = 0;
        var movingTime = InterleavedTiming.MeasureBestMilliseconds(
            () => Draw(view with { Camera = view.Camera with { Position = view.Camera.Position + (++drawCount * step) } }), MovingFrames);
        Draw(view);
        var stillTime = InterleavedTiming.MeasureBestMilliseconds(() => Draw(view), StillFrames);
        return new(start, movingTime, stillTime, bytes, renderer.Statistics, frame.Capture());

        void Draw(View drawnView)
        {
            frame.Draw(renderer, drawnView, FrameCase.Width, FrameCase.Height, optimisation.Settings);
            frame.Finish();
        }
    }

    private void AddRow(string scene, OptimisationCase optimisation, OptimisationSample sample, OptimisationSample first)
    {
        var ratio = ImageError.PeakSignalToNoiseRatio(sample.StillImage, first.StillImage);
        var difference = double.IsPositiveInfinity(ratio) ? "the same" : FormattableString.Invariant($"{ratio:F1} dB");
        var isCounted = optimisation.Unit.Length > 0;
        if (!isCounted || !double.IsPositiveInfinity(ratio))
        {
            SaveImages(isCounted ? scene + optimisation.Name[1..].Replace(' ', '-') : scene, sample.StillImage, first.StillImage);
        }

        var firstCount = optimisation.CounterOf(first);
        var count = optimisation.CounterOf(sample);
        var counted = isCounted ? FormattableString.Invariant($"{optimisation.Unit}: {firstCount:N0}, now {count:N0}") : "";
        var times = FormattableString.Invariant(
            $"{sample.StartMilliseconds,9:F1} {sample.MovingMilliseconds,10:F2} {sample.StillMilliseconds,12:F2}");
        WriteLine($"{optimisation.Name,-20} {times} {sample.AllocatedBytes / 1e6,8:F1} {difference,14}  {counted}");
        table?.Add(
            scene,
            isCounted ? optimisation.Name[2..] : "nothing",
            Math.Round(sample.StartMilliseconds, 3),
            Math.Round(sample.MovingMilliseconds, 3),
            Math.Round(sample.StillMilliseconds, 3),
            sample.AllocatedBytes,
            double.IsPositiveInfinity(ratio) ? null : Math.Round(ratio, 2),
            OptimisationCase.InstanceBudget,
            isCounted ? optimisation.Unit : null,
            isCounted ? firstCount : null,
            isCounted ? count : null);
    }

    private void SaveImages(string name, PixelImage image, PixelImage first)
    {
        if (images is null)
        {
            return;
        }

        image.SavePng(Path.Combine(images, name + ".png"));
        // The first image is its own reference.
        if (!ReferenceEquals(image, first))
        {
            ImageError.Difference(image, first, DifferenceFactor).SavePng(Path.Combine(images, name + "-difference.png"));
        }
    }

    private void WriteLine(FormattableString text) => output.WriteLine(text.ToString(CultureInfo.InvariantCulture));
}
