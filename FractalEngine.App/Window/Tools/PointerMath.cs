using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Render.Views;

namespace FractalEngine.App.Window.Tools;

/// <summary>Finds what the pointer means in the scene: places along an axis, and angles around one.</summary>
/// <param name="view">View of the frame, world space.</param>
/// <param name="width">Width of the frame in pixels.</param>
/// <param name="height">Height of the frame in pixels.</param>
internal readonly struct PointerMath(View view, int width, int height)
{
    // Sine of the smallest angle between a ray and an axis at which a hand can tell places along the axis apart.
    private const double MinAxisSine = 0.25;

    // Sine of the smallest angle between a ray and a plane at which their meeting is stable.
    private const double MinPlaneSine = 0.1;

    /// <summary>Height of the part of the frame that shows the scene, pixels.</summary>
    public int FrameHeight => view.Viewport(width, height).Height;

    /// <summary>Pixels from the upper left corner to a point; null where it is behind the camera.</summary>
    public (double X, double Y)? Project(Vector point) => view.Project(point, width, height) is var (x, y, _) ? (x, y) : null;

    /// <summary>Length of a line across the view at a point that is as long in the frame as so many pixels.</summary>
    public double LengthOf(double pixels, Vector point) =>
        pixels * 2 * view.HalfHeightAt(view.Camera.ToCameraSpace(point).Z) / FrameHeight;

    /// <summary>Direction in which the camera looks, of length 1.</summary>
    public Vector Forward => view.Camera.LocalAxes.V3;

    /// <summary>Finds the place on a line that is closest to the ray of a pixel.</summary>
    /// <param name="x">Pixels from the left edge.</param>
    /// <param name="y">Pixels from the upper edge.</param>
    /// <param name="point">A point of the line.</param>
    /// <param name="axis">Unit direction of the line.</param>
    /// <returns>Distance from the point along the axis; null where the ray runs along the line.</returns>
    public double? AlongAxis(double x, double y, Vector point, Vector axis)
    {
        var ray = RayAt(x, y);
        var cosine = Vector.Dot(ray.Direction, axis);
        var sineSquared = 1 - (cosine * cosine);
        if (sineSquared < MinAxisSine * MinAxisSine)
        {
            return null;
        }

        var between = ray.Origin - point;
        return (Vector.Dot(between, axis) - (cosine * Vector.Dot(between, ray.Direction))) / sineSquared;
    }

    /// <summary>Finds where the ray of a pixel meets a plane.</summary>
    /// <param name="x">Pixels from the left edge.</param>
    /// <param name="y">Pixels from the upper edge.</param>
    /// <param name="point">A point of the plane.</param>
    /// <param name="normal">Unit normal of the plane.</param>
    /// <returns>Null where the ray runs along the plane.</returns>
    public Vector? OnPlane(double x, double y, Vector point, Vector normal)
    {
        var ray = RayAt(x, y);
        var slope = Vector.Dot(ray.Direction, normal);
        return Math.Abs(slope) < MinPlaneSine
            ? null
            : ray.Origin + (Vector.Dot(point - ray.Origin, normal) / slope * ray.Direction);
    }

    /// <summary>Direction in which the camera looks at a point, of length 1.</summary>
    public Vector DirectionTo(Vector point) => view.Projection == Core.Scenes.Cameras.Projection.Perspective
        ? (point - view.Camera.Position).UnitVector() : view.Camera.LocalAxes.V3;

    private Ray RayAt(double x, double y)
    {
        var ray = view.RayThrough(x, y, width, height);
        return ray with { Direction = ray.Direction.UnitVector() };
    }
}
