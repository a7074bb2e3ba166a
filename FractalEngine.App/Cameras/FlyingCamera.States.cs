using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes.Cameras;

namespace FractalEngine.App.Cameras;

/// <content>States that the camera returns to, and takes over from other cameras.</content>
internal sealed partial class FlyingCamera
{
    // The addresses of states would fill the memory in deeper zooms. Such a state returns as exactly as a world position can.
    private const int MaxStateDepth = 10_000;

    /// <summary>The present state, for <see cref="Restore"/>.</summary>
    public CameraState State =>
        new(Pose, Camera, FocusDistance, _address is { Depth: > 0 and <= MaxStateDepth } ? _address.Clone() : null)
        {
            Hierarchy = _fractal?.Hierarchy,
        };

    /// <summary>Returns to the initial camera and projection.</summary>
    public void Reset()
    {
        Pose = _initialPose;
        FocusDistance = DistanceToCentre(Pose.Camera);
        ResetFractalAddress();
    }

    /// <summary>Returns to a state of this camera, or of one for the same fractal.</summary>
    public void Restore(CameraState state)
    {
        if (!ReferenceEquals(state.Hierarchy, _fractal?.Hierarchy))
        {
            // The fractal has been changed since.
            Pose = state.Pose;
            Place(state.WorldCamera);
            return;
        }

        if (_fractal is null || state.Address is not null)
        {
            _address = state.Address?.Clone();
            FocusDistance = state.FocusDistance;
        }
        else
        {
            Place(state.WorldCamera);
        }

        Pose = state.Pose;
    }

    /// <summary>Shows the same view as a camera for another scene, as exactly as a world position can.</summary>
    public void ContinueFrom(FlyingCamera other)
    {
        if (SharesStatesWith(other))
        {
            Restore(other.State);
        }
        else
        {
            Pose = other.Pose;
            Place(other.Camera);
        }
    }

    /// <summary>Tells whether the states of another camera can be restored here.</summary>
    public bool SharesStatesWith(FlyingCamera other) =>
        ReferenceEquals(_fractal?.Hierarchy, other._fractal?.Hierarchy) && _fractal?.ObjectToWorld == other._fractal?.ObjectToWorld;

    /// <summary>Continues from another camera in world space.</summary>
    public void MoveTo(Camera camera)
    {
        Place(camera);
        Pose = Pose with { FramedAspect = null };
    }

    private void Place(Camera camera)
    {
        Pose = Pose with { Camera = camera };
        FocusDistance = DistanceToCentre(camera);
        ResetFractalAddress();
    }

    /// <summary>Computes the address of the present camera in the fractal, if the scene has one.</summary>
    private void ResetFractalAddress()
    {
        if (_fractal is not null)
        {
            _address = new(_fractal.Hierarchy, _fractal.ObjectToWorld, Pose.Camera.Position);
            _address.Move(Vector.Zero);
            FocusDistance *= Math.Exp(-_address.LogUnit);
            Pose = Pose with { Camera = Pose.Camera with { Position = Vector.Zero }, MoveCount = Pose.MoveCount + 1 };
        }
    }
}
