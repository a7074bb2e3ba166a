using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Core.Views;

namespace FractalEngine.App.Cameras;

/// <content>Framing: cameras that show the whole scene, and follow it as it grows.</content>
internal sealed partial class FlyingCamera
{
    // How far a framing camera may stand from where it should, divided by its distance: framing leaves a fifth of the frame free.
    private const double MaxDrift = 0.2;

    /// <summary>Moves the camera so that the whole scene is visible in the present direction.</summary>
    /// <param name="aspect">Width divided by height of the frame.</param>
    public void FrameScene(double aspect) => FrameScene(Camera, aspect);

    /// <summary>Moves the camera so that the whole scene is visible in another direction.</summary>
    /// <param name="direction">The direction in which the camera looks, in the axes of a camera without rotation.</param>
    /// <param name="aspect">Width divided by height of the frame.</param>
    public void LookAlong(Vector direction, double aspect) =>
        FrameScene(Camera with { Rotation = CameraFraming.LookRotation(direction) }, aspect);

    /// <summary>
    /// Frames the scene again after its shape has changed, if that is where the camera stands, and if it would stand elsewhere by a fifth
    /// of its distance: what grows out of the frame or becomes small is followed, and all else leaves the view as it is.
    /// </summary>
    /// <param name="aspect">Width divided by height of the frame.</param>
    public void FollowShape(double aspect)
    {
        if (Pose.FramedAspect is not { } framedAspect || Depth > 0)
        {
            return;
        }

        var present = Camera;
        // For the frame as it was then: its own shape may have changed, too, which alone moves no camera.
        var (framed, height) = ComputeFraming(present, framedAspect);
        var drift = present.LocalAxesInverse * (framed.Position - present.Position);
        var hasDrifted = height is { } wanted
            ? Math.Max(Math.Max(Math.Abs(drift.X), Math.Abs(drift.Y)), Math.Abs(wanted - (OrthographicHeight ?? 0))) > MaxDrift * wanted
            : drift.Length() > MaxDrift * DistanceToCentre(framed);
        if (hasDrifted)
        {
            FrameScene(present, aspect);
        }
    }

    private void FrameScene(Camera camera, double aspect)
    {
        var (framed, height) = ComputeFraming(camera, aspect);
        Pose = Pose with { Camera = framed, OrthographicHeight = height };
        FocusDistance = DistanceToCentre(Pose.Camera);
        ResetFractalAddress();
        Pose = Pose with { FramedAspect = aspect };
    }

    private (Camera Camera, double? OrthographicHeight) ComputeFraming(Camera camera, double aspect)
    {
        var (framed, height) = (CameraFraming.Frame(camera, _sceneBounds, aspect), (double?)null);
        if (_scene is not null)
        {
            framed = CameraFraming.FrameScene(camera, _scene, aspect);
            (framed, height) = Projection == Projection.Orthographic
                ? CameraFraming.FrameSceneOrthographic(framed, _scene, aspect)
                : (framed, null);
        }

        return (framed, height);
    }
}
