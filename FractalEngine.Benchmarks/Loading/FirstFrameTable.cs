using System.Diagnostics;
using System.Numerics;
using FractalEngine.Benchmarks.Drawing;
using FractalEngine.Benchmarks.Measuring;
using FractalEngine.Parsing.Assets;
using FractalEngine.Render;
using FractalEngine.Render.Preparation;
using FractalEngine.Render.Windowing;

namespace FractalEngine.Benchmarks.Loading;

/// <summary>
/// How long from a file to its first picture, of 1280 × 720: parsed with all it refers to, prepared for the GPU, drawn to the last pixel?
/// In a process that has done it before, with a context that is open; both are rows of their own. Needs a display.
/// </summary>
internal static class FirstFrameTable
{
    private const int Width = 1280;
    private const int Height = 720;

    /// <summary>Writes the file.</summary>
    public static void Write(TableOptions options)
    {
        var opening = Stopwatch.StartNew();
        using var context = new OffscreenContext();
        using var frame = new FrameRenderer(context);
        var opened = opening.Elapsed.TotalMilliseconds;
        var table = options.CreateTable("first-picture.csv", "file", "run", "faces", "load_ms", "prepare_ms", "draw_ms", "total_ms");
        table.GraphicsDriver = context.DriverName;
        table.Add(null, "context alone", null, null, null, null, RoundMilliseconds(opened));
        var file = Path.Combine(FractalCase.Assets, "fractals", "menger.fdo");
        AddRow("first of the process", file, MeasureStages(file, context, frame));
        string[] files = [.. Directory.GetFiles(Path.Combine(FractalCase.Assets, "fractals"), "*.fdo"),
            .. Directory.GetFiles(Path.Combine(FractalCase.Assets, "scenes"), "*.sdo")];
        foreach (var name in files.Order(StringComparer.Ordinal))
        {
            var rounds = Enumerable.Range(0, options.IsQuick ? 2 : 5).Select(_ => MeasureStages(name, context, frame)).ToArray();
            AddRow("best", name, [.. Enumerable.Range(0, rounds[0].Length).Select(i => rounds.Min(round => round[i]))]);
        }

        table.Save();

        void AddRow(string run, string name, double[] stages) =>
            table.Add(Path.GetFileName(name), run, CountFaces(name), RoundMilliseconds(stages[0]), RoundMilliseconds(stages[1]),
            RoundMilliseconds(stages[2]),
            RoundMilliseconds(stages.Sum()));
    }

    private static BigInteger? CountFaces(string file) =>
        AssetLoader.Load(file).Scene.Objects.Aggregate((BigInteger?)0, (sum, item) => sum + item.Model.FaceCount);

    private static double RoundMilliseconds(double milliseconds) => Math.Round(milliseconds, 3);

    /// <summary>Milliseconds: loading, preparing, drawing.</summary>
    private static double[] MeasureStages(string file, OffscreenContext context, FrameRenderer frame)
    {
        var watch = Stopwatch.StartNew();
        var loaded = AssetLoader.Load(file);
        var load = watch.Elapsed.TotalMilliseconds;
        var (settings, view) = (new RenderSettings { Samples = 0 }, View.Of(loaded.Scene, FrameCase.Aspect));
        var preparation = new ScenePreparation(loaded.Scene, settings);
        preparation.PrepareVisible(view, FrameCase.Aspect);
        var prepare = watch.Elapsed.TotalMilliseconds - load;
        using var renderer = new SceneRenderer(context, preparation.Scene);
        frame.Draw(renderer, view, Width, Height, settings);
        frame.Finish();
        return [load, prepare, watch.Elapsed.TotalMilliseconds - load - prepare];
    }
}
