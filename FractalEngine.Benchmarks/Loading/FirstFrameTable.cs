using System.Diagnostics;
using System.Numerics;
using FractalEngine.Benchmarks.Drawing;
using FractalEngine.Benchmarks.Measuring;
using FractalEngine.Parsing.Assets;
using FractalEngine.Render;
using FractalEngine.Render.Preparation;
using FractalEngine.Render.Views;
using FractalEngine.Render.Windowing;

namespace FractalEngine.Benchmarks.Loading;

/// <summary>
/// How long does it take from a file to its first frame? The file is parsed with all that it refers to, prepared for the GPU, and drawn to
/// the last pixel. The process has done so before, and its context is open; both have rows of their own. Needs a display.
/// </summary>
internal static class FirstFrameTable
{
    /// <summary>Measures and writes all rows of the table.</summary>
    /// <exception cref="GraphicsUnavailableException">There is no display, or no OpenGL.</exception>
    public static void Write(TableOptions options)
    {
        var openingWatch = Stopwatch.StartNew();
        using var context = new OffscreenContext();
        using var frame = new FrameRenderer(context);
        var openingTime = openingWatch.Elapsed.TotalMilliseconds;
        var table = options.CreateTable("first-frame.csv", "file", "run", "faces", "load_ms", "prepare_ms", "draw_ms", "total_ms");
        table.GraphicsDriver = context.DriverName;
        table.Add(null, "context alone", null, null, null, null, RoundMilliseconds(openingTime));
        var firstFile = Path.Combine(FractalCase.Assets, "fractals", "menger.fdo");
        AddRow("first of the process", firstFile, MeasureStages(firstFile, context, frame));
        foreach (var file in LoadingTable.AssetFiles)
        {
            var rounds = Enumerable.Range(0, options.IsQuick ? 2 : 5).Select(_ => MeasureStages(file, context, frame)).ToArray();
            AddRow("best", file, [.. Enumerable.Range(0, rounds[0].Length).Select(stage => rounds.Min(round => round[stage]))]);
        }

        table.Save();

        void AddRow(string run, string file, double[] stages) => table.Add(
            Path.GetFileName(file), run, CountFaces(file), RoundMilliseconds(stages[0]), RoundMilliseconds(stages[1]),
            RoundMilliseconds(stages[2]), RoundMilliseconds(stages.Sum()));
    }

    private static BigInteger? CountFaces(string file) =>
        AssetLoader.Load(file).Scene.Sum(static model => model.FaceCount);

    private static double RoundMilliseconds(double milliseconds) => Math.Round(milliseconds, 3);

    /// <summary>Measures the milliseconds of loading, preparing and drawing.</summary>
    private static double[] MeasureStages(string file, OffscreenContext context, FrameRenderer frame)
    {
        var watch = Stopwatch.StartNew();
        var loaded = AssetLoader.Load(file);
        var loadTime = watch.Elapsed.TotalMilliseconds;
        var settings = new RenderSettings { Samples = 0 };
        var view = View.Of(loaded.Scene, FrameCase.Aspect);
        var preparation = new ScenePreparation(loaded.Scene, settings);
        preparation.PrepareVisible(view, FrameCase.Aspect);
        var prepareTime = watch.Elapsed.TotalMilliseconds - loadTime;
        using var renderer = new SceneRenderer(context, preparation.Scene);
        frame.Draw(renderer, view, FrameCase.Width, FrameCase.Height, settings);
        frame.Finish();
        return [loadTime, prepareTime, watch.Elapsed.TotalMilliseconds - loadTime - prepareTime];
    }
}
