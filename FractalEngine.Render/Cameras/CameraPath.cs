using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Core.Views;

namespace FractalEngine.Render.Cameras;

/// <summary>
/// A camera that passes through the cameras of a list at equal times: positions on a Catmull-Rom spline, orientations and angles of view
/// in between.
/// </summary>
public sealed class CameraPath
{
    /// <summary>Largest coordinate of a camera, with which products of the spline stay doubles.</summary>
    public const double MaxCoordinate = 1e150;

    private readonly Camera[] _cameras;
    private readonly Handedness _handedness;

    /// <summary>Makes a path through cameras.</summary>
    /// <param name="cameras">At least two, with coordinates up to <see cref="MaxCoordinate"/>.</param>
    /// <param name="handedness">That of the scene.</param>
    /// <exception cref="ArgumentOutOfRangeException">There are fewer than two cameras.</exception>
    public CameraPath(IEnumerable<Camera> cameras, Handedness handedness)
    {
        _cameras = [.. cameras];
        ArgumentOutOfRangeException.ThrowIfLessThan(_cameras.Length, 2, nameof(cameras));
        _handedness = handedness;
    }

    /// <summary>Returns the camera at a time.</summary>
    /// <param name="time">0 at the first camera, 1 at the last.</param>
    public Camera At(double time)
    {
        var scaled = Math.Clamp(time, 0, 1) * (_cameras.Length - 1);
        var index = Math.Min((int)scaled, _cameras.Length - 2);
        var fraction = scaled - index;
        var (from, to) = (_cameras[index], _cameras[index + 1]);
        var before = _cameras[Math.Max(index - 1, 0)];
        var after = _cameras[Math.Min(index + 2, _cameras.Length - 1)];
        var position = Spline(before.Position, from.Position, to.Position, after.Position, fraction);
        var forward = Between(from.LocalAxes.V3, to.LocalAxes.V3, fraction);
        // Two opposite directions have no middle; the turn then happens at once.
        var direction = forward.Length() > 1e-6 ? forward : from.LocalAxes.V3;
        var fieldOfView = from.FieldOfView + (fraction * (to.FieldOfView - from.FieldOfView));
        // Far away, a point before the camera would be the camera's own.
        return CameraFraming.LookAt(Vector.Zero, direction, UpBetween(from, to, fraction), fieldOfView, _handedness) with
        {
            Position = position,
            Aperture = from.Aperture + (fraction * (to.Aperture - from.Aperture)),
            FocusDepth = from.FocusDepth + (fraction * (to.FocusDepth - from.FocusDepth)),
        };
    }

    private static Vector UpBetween(Camera from, Camera to, double fraction)
    {
        var up = Between(from.LocalAxes.V2, to.LocalAxes.V2, fraction);
        return up.Length() > 1e-6 ? up : from.LocalAxes.V2;
    }

    private static Vector Between(Vector from, Vector to, double fraction) => ((1 - fraction) * from) + (fraction * to);

    private static Vector Spline(Vector before, Vector from, Vector to, Vector after, double t)
    {
        var (startSlope, endSlope) = (0.5 * (to - before), 0.5 * (after - from));
        var (t2, t3) = (t * t, t * t * t);
        return (((2 * t3) - (3 * t2) + 1) * from) + ((t3 - (2 * t2) + t) * startSlope)
            + (((3 * t2) - (2 * t3)) * to) + ((t3 - t2) * endSlope);
    }
}
