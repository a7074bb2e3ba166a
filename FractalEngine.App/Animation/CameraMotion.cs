using FractalEngine.App.Cameras;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Render.Preparation;
using FractalEngine.Render.Views;

namespace FractalEngine.App.Animation;

/// <summary>How the view of an animation depends on the frame.</summary>
internal static class CameraMotion
{
    /// <summary>Shows the same view in every frame, for animations in which only bodies move.</summary>
    public static Func<int, View> Still(View view) => _ => view;

    /// <summary>Turns once around a point, so that the last frame leads on to the first.</summary>
    /// <param name="view">The view of the first frame.</param>
    /// <param name="pivot">World space.</param>
    /// <param name="frameCount">Number of frames of the turn.</param>
    public static Func<int, View> Turntable(View view, Vector pivot, int frameCount) =>
        frame => view with { Camera = CameraNavigation.Orbit(view.Camera, pivot, 2 * Math.PI * frame / frameCount, 0) };

    /// <summary>Flies into a fractal at an even pace. Frames must be asked for in order.</summary>
    /// <param name="drawable">A scene whose only object is a fractal.</param>
    /// <param name="view">The view of the first frame.</param>
    /// <param name="levels">Number of levels to the last frame.</param>
    /// <param name="frameCount">Number of frames.</param>
    public static Func<int, View> Zoom(DrawableScene drawable, View view, double levels, int frameCount)
    {
        var zoom = new CameraZoom(drawable, view);
        var steps = zoom.CountSteps(levels);
        return frame => zoom.FlyTo(steps * frame / Math.Max(1, frameCount - 1));
    }

    /// <summary>Follows a path from its first camera to its last.</summary>
    public static Func<int, View> Along(CameraPath path, View view, int frameCount) =>
        frame => view with { Camera = path.At((double)frame / Math.Max(1, frameCount - 1)) };
}
