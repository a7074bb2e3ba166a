using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Scenes.Cameras;

/// <summary>
/// Turns, moves and zooms a camera as mouse and keys ask. All of it works on the camera's axes; the angles for the file are derived from
/// them, so that the camera never rolls by itself.
/// </summary>
public static class CameraNavigation
{
    // Just short of straight up and down, where "left" would change sides.
    private const double MaxElevation = 89.9 * Math.PI / 180;

    /// <summary>Turns a camera in place: left and right about the world's up, up and down about its own right.</summary>
    /// <param name="camera">The camera.</param>
    /// <param name="right">Radians to the right.</param>
    /// <param name="up">Radians upwards; ends just short of the zenith and the nadir.</param>
    public static Camera Turn(Camera camera, double right, double up) =>
        camera with { Rotation = (ComputeTurn(camera, right, up) * camera.Rotation.LocalAxes()).Orthonormalized().EulerAngles() };

    /// <summary>Moves a camera around a point, which stays where it is in the image.</summary>
    /// <param name="camera">The camera.</param>
    /// <param name="pivot">World space.</param>
    /// <param name="right">Radians by which the view turns to the right.</param>
    /// <param name="up">Radians by which it turns upwards.</param>
    public static Camera Orbit(Camera camera, Vector pivot, double right, double up)
    {
        var turn = ComputeTurn(camera, right, up);
        var offset = turn * camera.Handedness.Mirror(camera.Position - pivot);
        return Turn(camera, right, up) with { Position = pivot + camera.Handedness.Mirror(offset) };
    }

    /// <summary>Moves a camera along its own axes.</summary>
    /// <param name="camera">The camera.</param>
    /// <param name="distances">To the right, up and forward, scene units.</param>
    public static Camera Move(Camera camera, Vector distances) =>
        camera with { Position = camera.Position + (camera.LocalAxes * distances) };

    /// <summary>Moves a camera towards a point or away from it.</summary>
    /// <param name="camera">The camera.</param>
    /// <param name="pivot">World space.</param>
    /// <param name="factor">The new distance divided by the old one, positive.</param>
    public static Camera Zoom(Camera camera, Vector pivot, double factor) =>
        camera with { Position = pivot + (factor * (camera.Position - pivot)) };

    /// <summary>Computes a turn in the left-handed space that the rotation of every camera is given in.</summary>
    private static Matrix ComputeTurn(Camera camera, double right, double up)
    {
        var axes = camera.Rotation.LocalAxes();
        var elevation = Math.Asin(Math.Clamp(axes.V3.Y, -1, 1));
        var target = Math.Clamp(elevation + up, -MaxElevation, MaxElevation);
        // A camera that starts beyond the limit (the view from the top) is not pulled back by a turn to the side.
        var elevationChange = up == 0 ? 0 : target - elevation;
        return Matrix.Rotation(Vector.J, right) * Matrix.Rotation(axes.V1, -elevationChange);
    }
}
