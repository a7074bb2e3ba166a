using System.Diagnostics;
using FractalEngine.Core.Maths;
using FractalEngine.Render;

namespace FractalEngine.Benchmarks.Drawing;

/// <summary>
/// Pictures of a camera that flies, drawn as the window draws them: coarser, and one behind, while the next one's instances are chosen.
/// </summary>
/// <param name="FrameCount">How many were drawn.</param>
/// <param name="Seconds">How long that took.</param>
/// <param name="SlowestMilliseconds">Of the pictures, milliseconds.</param>
/// <param name="MeanInstanceCount">The mean of the pictures.</param>
internal sealed record CameraFlight(int FrameCount, double Seconds, double SlowestMilliseconds, long MeanInstanceCount)
{
    private static readonly TimeSpan Duration = TimeSpan.FromSeconds(5);

    /// <summary>Flies ahead and back: to the fractal's middle, or, where it begins near that, by a tenth of the fractal's size.</summary>
    /// <param name="frame">Draws.</param>
    /// <param name="renderer">Of the fractal.</param>
    /// <param name="frameCase">The fractal, and where the flight begins.</param>
    /// <param name="settings">Of a picture that stands.</param>
    /// <param name="size">Of the pictures, pixels.</param>
    public static CameraFlight Measure(FrameRenderer frame, SceneRenderer renderer, FrameCase frameCase, RenderSettings settings,
        (int Width, int Height) size)
    {
        var quality = new AdaptiveQuality();
        var (camera, bounds) = (frameCase.View.Camera, frameCase.Scene.Bounds);
        var path = Math.Max(0.1 * bounds.Diagonal, (bounds.Centre - camera.Position).Length() - (0.1 * bounds.Diagonal))
            * camera.LocalAxes.V3;
        var (frameCount, slowest, instances) = (0, 0.0, 0L);
        View? next = null;
        var clock = Stopwatch.StartNew();
        while (clock.Elapsed < Duration)
        {
            var start = clock.Elapsed;
            var view = Translate(frameCase.View, 0.5 * (1 - Math.Cos(2 * Math.PI * (start / Duration))) * path);
            (var drawnView, next) = (next ?? view, view);
            frame.Draw(renderer, drawnView, size.Width, size.Height, quality.Adapt(settings), view);
            frame.Finish();
            var time = clock.Elapsed - start;
            quality.RecordFrameTime(time);
            instances += renderer.Statistics.InstanceCount;
            (frameCount, slowest) = (frameCount + 1, Math.Max(slowest, time.TotalMilliseconds));
        }

        return new(frameCount, clock.Elapsed.TotalSeconds, slowest, instances / frameCount);
    }

    private static View Translate(View view, Vector offset) =>
        view with { Camera = view.Camera with { Position = view.Camera.Position + offset } };
}
