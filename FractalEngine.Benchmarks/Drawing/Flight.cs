using System.Diagnostics;
using FractalEngine.Core.Maths;
using FractalEngine.Render;

namespace FractalEngine.Benchmarks.Drawing;

/// <summary>
/// Pictures of a camera that flies, drawn as the window draws them: coarser, and one behind, while the next one's instances are chosen.
/// </summary>
/// <param name="Pictures">How many were drawn.</param>
/// <param name="Seconds">How long that took.</param>
/// <param name="Slowest">Of the pictures, milliseconds.</param>
/// <param name="Instances">The mean of the pictures.</param>
internal sealed record Flight(int Pictures, double Seconds, double Slowest, long Instances)
{
    private static readonly TimeSpan Length = TimeSpan.FromSeconds(5);

    /// <summary>Flies ahead and back: to the fractal's middle, or, where it begins near that, by a tenth of the fractal's size.</summary>
    /// <param name="frame">Draws.</param>
    /// <param name="renderer">Of the fractal.</param>
    /// <param name="item">The fractal, and where the flight begins.</param>
    /// <param name="settings">Of a picture that stands.</param>
    /// <param name="size">Of the pictures, pixels.</param>
    public static Flight Of(FrameRenderer frame, SceneRenderer renderer, FrameCase item, RenderSettings settings,
        (int Width, int Height) size)
    {
        var moving = new AdaptiveQuality();
        var (camera, bounds) = (item.View.Camera, item.Scene.Bounds);
        var way = Math.Max(0.1 * bounds.Diagonal, (bounds.Centre - camera.Position).Length() - (0.1 * bounds.Diagonal))
            * camera.LocalAxes.V3;
        var (pictures, slowest, instances) = (0, 0.0, 0L);
        View? next = null;
        var clock = Stopwatch.StartNew();
        while (clock.Elapsed < Length)
        {
            var start = clock.Elapsed;
            var view = At(item.View, 0.5 * (1 - Math.Cos(2 * Math.PI * (start / Length))) * way);
            (var drawn, next) = (next ?? view, view);
            frame.Draw(renderer, drawn, size.Width, size.Height, moving.Adapt(settings), view);
            frame.Finish();
            var time = clock.Elapsed - start;
            moving.RecordFrameTime(time);
            instances += renderer.Statistics.InstanceCount;
            (pictures, slowest) = (pictures + 1, Math.Max(slowest, time.TotalMilliseconds));
        }

        return new(pictures, clock.Elapsed.TotalSeconds, slowest, instances / pictures);
    }

    private static View At(View view, Vector offset) =>
        view with { Camera = view.Camera with { Position = view.Camera.Position + offset } };
}
