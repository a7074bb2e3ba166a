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
    private const int Deepest = 5;

    // Another view, so that nothing is kept from the picture before; less than a thousandth of a pixel away.
    private const double Step = 1e-9;

    /// <summary>Writes the file, or one line where there is no display.</summary>
    public static void Write(TableOptions options)
    {
        try
        {
            using var context = new OffscreenContext();
            using var frame = new FrameRenderer(context);
            var table = options.Table("drawing.csv", "fractal", "depth", "faces", "drawn", "instances", "ms", "driver");
            for (var depth = 1; depth <= Deepest; depth++)
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
        var item = FrameCase.Parse(name);
        var chosen = new RenderSettings { Samples = 0 };
        var all = chosen with { Culling = null, InstanceBudget = 20_000_000 };
        using var chosenScene = new SceneRenderer(context, DrawableScene.Prepare(item.Scene, chosen));
        var everything = DrawableScene.Prepare(item.Scene, all);
        using var allScene = new SceneRenderer(context, everything);
        var times = TakeTurns.Best([() => Draw(frame, chosenScene, item, chosen), () => Draw(frame, allScene, item, all)], options.IsQuick
            ? 2
            : 7);
        var faces = item.Scene.Objects[0].Model.FaceCount;
        table.Add("menger", depth, faces, "chosen", chosenScene.Statistics.InstanceCount, Math.Round(1e3 * times[0], 3),
            context.DriverName);
        table.Add("menger", depth, faces, "all", everything.InstanceCount, Math.Round(1e3 * times[1], 3), context.DriverName);
    }

    private static int _step;

    private static void Draw(FrameRenderer frame, SceneRenderer renderer, FrameCase item, RenderSettings settings)
    {
        var camera = item.View.Camera;
        var moved = camera with { Position = camera.Position + (Step * (++_step % 2) * Core.Maths.Vector.One) };
        frame.Draw(renderer, item.View with { Camera = moved }, Width, Height, settings);
        frame.Finish();
    }
}
