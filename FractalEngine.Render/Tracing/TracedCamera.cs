using System.Runtime.CompilerServices;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Render.Views;

namespace FractalEngine.Render.Tracing;

/// <summary>Makes the rays of a view's pixels.</summary>
/// <param name="view">Camera and projection.</param>
/// <param name="width">Width of the frame in pixels.</param>
/// <param name="height">Height of the frame in pixels.</param>
/// <param name="footprintPixels">Radius of a ray in pixels.</param>
internal sealed class TracedCamera(View view, int width, int height, double footprintPixels)
{
    private readonly Camera _camera = view.Camera;
    private readonly bool _isPerspective = view.Projection == Projection.Perspective;
    private readonly double _halfHeight = view.HalfHeight;
    private readonly double _halfWidth = view.HalfHeight * view.EffectiveAspect(width, height);
    private readonly double _footprint = footprintPixels * 2 * view.HalfHeight / view.Viewport(width, height).Height;
    private readonly (double Near, double Far) _clip = view.FixedClipPlanes ?? (0, double.PositiveInfinity);

    // May reach beyond the sides of the frame.
    private readonly (int X, int Y, int Width, int Height) _image = view.Viewport(width, height);

    /// <summary>The part of the frame that shows the scene, in pixels from the upper left corner.</summary>
    public (int X, int Y, int Width, int Height) Viewport
    {
        get
        {
            var (left, right) = (Math.Max(0, _image.X), Math.Min(width, _image.X + _image.Width));
            return _image with { X = left, Width = right - left };
        }
    }

    /// <summary>Distance of a point from the plane of the camera.</summary>
    public double DepthOf(Core.Maths.Vector position) => _camera.ToCameraSpace(position).Z;

    /// <summary>Whether rays start at points of a lens.</summary>
    public bool HasLens => view.HasLens;

    /// <summary>Makes a ray near the centre of a pixel, from the middle of the lens.</summary>
    /// <param name="x">Pixel from the left, from 0.</param>
    /// <param name="y">Pixel from the top, from 0.</param>
    /// <param name="point">A point of the unit square, which the filter spreads over the pixel and its neighbours.</param>
    /// <param name="footprint">How wide the ray is.</param>
    /// <param name="clip">The smallest and the largest distance along the ray that are shown: where it meets the clip planes.</param>
    public Ray CreateRay(
        int x, int y, (double U, double V) point, out RayFootprint footprint, out (double Near, double Far) clip)
    {
        var across = (((x + 0.5 + Tent(point.U) - _image.X) / _image.Width) * 2) - 1;
        var down = (((y + 0.5 + Tent(point.V) - _image.Y) / _image.Height) * 2) - 1;
        var (right, up) = (across * _halfWidth, -down * _halfHeight);
        var (axisRight, axisUp, forward) = _camera.LocalAxes;
        if (_isPerspective)
        {
            var direction = (right * axisRight) + (up * axisUp) + forward;
            var length = direction.Length();
            footprint = new(0, _footprint / length);
            // The part along the axis is 1, so that a depth of 1 is this distance.
            clip = (length * _clip.Near, length * _clip.Far);
            return new(_camera.Position, direction / length);
        }

        footprint = new(_footprint, 0);
        clip = _clip;
        return new(_camera.Position + (right * axisRight) + (up * axisUp), forward);
    }

    /// <summary>Moves a ray to a point of a thin lens: it meets the other one where that is in focus.</summary>
    /// <param name="ray">From the middle of the lens.</param>
    /// <param name="point">A point of the unit square.</param>
    /// <param name="footprint">How wide the ray is.</param>
    /// <param name="clip">The smallest and the largest distance along the ray that are shown.</param>
    public Ray ThroughLens(Ray ray, (double U, double V) point, ref RayFootprint footprint, ref (double Near, double Far) clip)
    {
        var (axisRight, axisUp, forward) = _camera.LocalAxes;
        var (right, up) = view.LensPoint(point);
        var origin = ray.Origin + (right * axisRight) + (up * axisUp);
        var target = ray.Origin + (_camera.FocusDepth / Core.Maths.Vector.Dot(ray.Direction, forward) * ray.Direction);
        var length = (target - origin).Length() / _camera.FocusDepth;
        footprint = new(0, _footprint / length);
        clip = (length * _clip.Near, length * _clip.Far);
        return new(origin, (target - origin) / (length * _camera.FocusDepth));
    }

    /// <summary>Spreads a number from 0 to 1 over −1 to 1, as densely as a tent is high.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public static double Tent(double number) => number < 0.5 ? Math.Sqrt(2 * number) - 1 : 1 - Math.Sqrt(2 - (2 * number));
}
