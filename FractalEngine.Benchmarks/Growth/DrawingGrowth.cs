using FractalEngine.Benchmarks.Drawing;
using FractalEngine.Benchmarks.Measuring;
using FractalEngine.Render;
using FractalEngine.Render.Preparation;
using FractalEngine.Render.Views;
using FractalEngine.Render.Windowing;

namespace FractalEngine.Benchmarks.Growth;

/// <summary>
/// How does the time of a frame grow with the faces of a sponge, if every instance is drawn and if only visible ones are? Needs a display.
/// </summary>
internal static class DrawingGrowth
{
    private const int MaxDepth = 5;

    /// <summary>Writes the table, or one line to standard output where there is no display.</summary>
    public static void Write(TableOptions options)
    {
        try
        {
            using var context = new OffscreenContext();
            using var frame = new FrameRenderer(context);
            var table = options.CreateTable("drawing.csv", "fractal", "depth", "faces", "drawn", "instances", "ms", "driver");
            for (var depth = 1; depth <= MaxDepth; depth++)
            {
                AddRows(table, depth, context, frame, options);
            }

            table.Save();
        }
        catch (GraphicsUnavailableException exception)
        {
            Console.WriteLine($"drawing.csv is skipped: {exception.Message}");
        }
    }

    private static void AddRows(CsvTable table, int depth, OffscreenContext context, FrameRenderer frame, TableOptions options)
    {
        var frameCase = FrameCase.Parse(FormattableString.Invariant($"menger:{depth}:afar"));
        var culledSettings = new RenderSettings { Samples = 0 };
        var everyInstanceSettings = culledSettings with { Culling = null, InstanceBudget = 20_000_000 };
        using var culledRenderer = new SceneRenderer(context, DrawableScene.Prepare(frameCase.Scene, culledSettings));
        var everyInstance = DrawableScene.Prepare(frameCase.Scene, everyInstanceSettings);
        using var everyInstanceRenderer = new SceneRenderer(context, everyInstance);
        // Each renderer draws another view than before, so that nothing is reused.
        var drawCount = 0;
        var times = InterleavedTiming.MeasureBestSeconds(
            [() => Draw(culledRenderer, culledSettings, drawCount), () => Draw(everyInstanceRenderer, everyInstanceSettings, drawCount++)],
            options.IsQuick ? 2 : 7);
        var faces = frameCase.Scene.Objects[0].Model.FaceCount;
        AddRow("culled", culledRenderer.Statistics.InstanceCount, times[0]);
        AddRow("all", everyInstance.InstanceCount, times[1]);

        void Draw(SceneRenderer renderer, RenderSettings settings, int count)
        {
            frame.Draw(renderer, frameCase.PerturbedView(count), FrameCase.Width, FrameCase.Height, settings);
            frame.Finish();
        }

        void AddRow(string drawn, long instanceCount, double seconds) =>
            table.Add("menger", depth, faces, drawn, instanceCount, Math.Round(1e3 * seconds, 3), context.DriverName);
    }
}
