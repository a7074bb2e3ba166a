using System.Diagnostics;
using FractalEngine.Core.Maths;
using FractalEngine.Render;
using FractalEngine.Render.Views;

namespace FractalEngine.Benchmarks.Drawing;

/// <summary>
/// Frames of a flying camera, drawn as the window draws them: coarser than still ones, and one frame behind, while the instances of the
/// next frame are culled.
/// </summary>
/// <param name="FrameCount">Number of frames that were drawn.</param>
/// <param name="Seconds">Time of all frames in seconds.</param>
/// <param name="SlowestMilliseconds">Time of the slowest frame in milliseconds.</param>
/// <param name="MeanInstanceCount">Mean number of instances in a frame.</param>
internal sealed record CameraFlight(int FrameCount, double Seconds, double SlowestMilliseconds, long MeanInstanceCount)
{
    private static readonly TimeSpan Duration = TimeSpan.FromSeconds(5);

    /// <summary>
    /// Flies ahead and back: to the fractal's middle, or by a tenth of the fractal's size where the flight starts near the middle.
    /// </summary>
    /// <param name="frame">Renderer of the frames.</param>
    /// <param name="renderer">Renderer of the fractal.</param>
    /// <param name="frameCase">The fractal, and the view in which the flight starts.</param>
    /// <param name="settings">Settings of a still frame.</param>
    public static CameraFlight Measure(FrameRenderer frame, SceneRenderer renderer, FrameCase frameCase, RenderSettings settings)
    {
        var quality = new AdaptiveQuality();
        var camera = frameCase.View.Camera;
        var bounds = frameCase.Scene.Bounds;
        var distance = (bounds.Centre - camera.Position).Length();
        var path = Math.Max(0.1 * bounds.Diagonal, distance - (0.1 * bounds.Diagonal)) * camera.LocalAxes.V3;
        var frameCount = 0;
        var slowest = 0.0;
        var instances = 0L;
        View? next = null;
        var clock = Stopwatch.StartNew();
        while (clock.Elapsed < Duration)
        {
            var start = clock.Elapsed;
            var view = Translate(frameCase.View, 0.5 * (1 - Math.Cos(2 * Math.PI * (start / Duration))) * path);
            var drawnView = next ?? view;
            next = view;
            frame.Draw(renderer, drawnView, FrameCase.Width, FrameCase.Height, quality.Adapt(settings, mayEnlarge: true), view);
            frame.Finish();
            var time = clock.Elapsed - start;
            quality.RecordFrameTime(time);
            instances += renderer.Statistics.InstanceCount;
            frameCount++;
            slowest = Math.Max(slowest, time.TotalMilliseconds);
        }

        return new(frameCount, clock.Elapsed.TotalSeconds, slowest, instances / frameCount);
    }

    private static View Translate(View view, Vector offset) =>
        view with { Camera = view.Camera with { Position = view.Camera.Position + offset } };
}
