using FractalEngine.Benchmarks.Drawing;
using FractalEngine.Benchmarks.Measuring;
using FractalEngine.Render;
using FractalEngine.Render.Preparation;
using FractalEngine.Render.Windowing;

namespace FractalEngine.Benchmarks.Growth;

/// <summary>
/// How does the time of a picture grow with the faces of a sponge: every instance drawn, and those chosen that can be seen? Needs a
/// display.
/// </summary>
internal static class DrawingGrowth
{
    private const int Width = 1280;
    private const int Height = 720;
    private const int MaxDepth = 5;

    // Another view, so that nothing is kept from the picture before; less than a thousandth of a pixel away.
    private const double CameraPerturbation = 1e-9;

    /// <summary>Writes the file, or one line where there is no display.</summary>
    public static void Write(TableOptions options)
    {
        try
        {
            using var context = new OffscreenContext();
            using var frame = new FrameRenderer(context);
            var table = options.CreateTable("drawing.csv", "fractal", "depth", "faces", "drawn", "instances", "ms", "driver");
            for (var depth = 1; depth <= MaxDepth; depth++)
            {
                Write(FormattableString.Invariant($"menger:{depth}:afar"), depth, context, frame, options, table);
            }

            table.Save();
        }
        catch (GraphicsUnavailableException exception)
        {
            Console.WriteLine($"drawing.csv is left out: {exception.Message}");
        }
    }

    private static void Write(string name, int depth, OffscreenContext context, FrameRenderer frame, TableOptions options, CsvTable table)
    {
        var frameCase = FrameCase.Parse(name);
        var culledSettings = new RenderSettings { Samples = 0 };
        var everyInstanceSettings = culledSettings with { Culling = null, InstanceBudget = 20_000_000 };
        using var culledRenderer = new SceneRenderer(context, DrawableScene.Prepare(frameCase.Scene, culledSettings));
        var everyInstance = DrawableScene.Prepare(frameCase.Scene, everyInstanceSettings);
        using var everyInstanceRenderer = new SceneRenderer(context, everyInstance);
        var times =
            InterleavedTiming.MeasureBestSeconds(
                [() => DrawPerturbed(frame, culledRenderer, frameCase, culledSettings),
                () => DrawPerturbed(frame, everyInstanceRenderer, frameCase, everyInstanceSettings)], options.IsQuick
            ? 2
            : 7);
        var faces = frameCase.Scene.Objects[0].Model.FaceCount;
        table.Add("menger", depth, faces, "chosen", culledRenderer.Statistics.InstanceCount, Math.Round(1e3 * times[0], 3),
            context.DriverName);
        table.Add("menger", depth, faces, "all", everyInstance.InstanceCount, Math.Round(1e3 * times[1], 3), context.DriverName);
    }

    private static int _drawCount;

    private static void DrawPerturbed(FrameRenderer frame, SceneRenderer renderer, FrameCase frameCase, RenderSettings settings)
    {
        var camera = frameCase.View.Camera;
        var moved = camera with { Position = camera.Position + (CameraPerturbation * (++_drawCount % 2) * Core.Maths.Vector.One) };
        frame.Draw(renderer, frameCase.View with { Camera = moved }, Width, Height, settings);
        frame.Finish();
    }
}
