using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Core.Visibility.Frames;

namespace FractalEngine.Render.Views;

/// <summary>A view resolved for one frame: its viewport, aspect ratio and clip planes.</summary>
/// <param name="View">Camera and projection.</param>
/// <param name="X">Left edge of the viewport, pixels from the left of the frame.</param>
/// <param name="Y">Top edge of the viewport, pixels from the top of the frame.</param>
/// <param name="Width">Width of the viewport in pixels.</param>
/// <param name="Height">Height of the viewport in pixels.</param>
/// <param name="Aspect">Width divided by height of the viewport, before rounding to pixels.</param>
/// <param name="Near">Depth of the near clip plane, scene units.</param>
/// <param name="Far">Depth of the far clip plane, scene units.</param>
internal readonly record struct FrameView(View View, int X, int Y, int Width, int Height, double Aspect, double Near, double Far)
{
    /// <summary>Resolves a view for a frame.</summary>
    /// <param name="view">Camera and projection.</param>
    /// <param name="width">Width of the frame in pixels.</param>
    /// <param name="height">Height of the frame in pixels.</param>
    /// <param name="planes">Depths of the clip planes, scene units; null where nothing is drawn.</param>
    public static FrameView Create(View view, int width, int height, (double Near, double Far)? planes)
    {
        var viewport = view.Viewport(width, height);
        var (near, far) = planes ?? view.ClipPlanes(BoundingBox.Empty);
        return new(view, viewport.X, viewport.Y, viewport.Width, viewport.Height, view.EffectiveAspect(width, height), near, far);
    }

    /// <summary>Plane that cuts the scene open, in world axes about the camera; null for none.</summary>
    public SectionPlane? Section { get; } = View.RelativeSection;

    /// <summary>How far the image of a perspective view is moved on the screen, in pixels to the right and upwards.</summary>
    public (double X, double Y) Offset { get; init; }

    /// <summary>
    /// Maps world axes to the camera's: right, up and depth. With an <see cref="Offset"/> the first two grow with the depth.
    /// </summary>
    public Matrix AxesInverse
    {
        get
        {
            var axes = View.Camera.LocalAxesInverse;
            if (Offset == default)
            {
                return axes;
            }

            var (right, up) = (2 * Offset.X / Width * View.HalfHeight * Aspect, 2 * Offset.Y / Height * View.HalfHeight);
            return new Matrix(new(1, 0, 0), new(0, 1, 0), new(right, up, 1)) * axes;
        }
    }

    /// <summary>Returns the same view in the form that culling takes.</summary>
    public CullingView ToCullingView() => new(
        View.Camera.Position, View.Camera.LocalAxes, View.Projection == Projection.Perspective, View.HalfHeight, Width, Height, Aspect,
        Near, Far)
    {
        Section = Section,
        Offset = Offset,
    };
}
