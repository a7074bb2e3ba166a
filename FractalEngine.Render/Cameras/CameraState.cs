using FractalEngine.Core.DeepZoom;
using FractalEngine.Core.Scenes.Cameras;

namespace FractalEngine.Render.Cameras;

/// <summary>All that returns a flying camera to where it was, at any depth of a fractal. Equal states show the same view.</summary>
/// <param name="Pose">The pose of the camera.</param>
/// <param name="WorldCamera">The camera in world space.</param>
/// <param name="FocusDistance">Distance of the point in focus, in the present unit.</param>
/// <param name="Address">The address in the fractal, which nobody moves; null outside of fractals.</param>
public sealed record CameraState(CameraPose Pose, Camera WorldCamera, double FocusDistance, FractalAddress? Address)
{
    /// <summary>The fractal that the address is in; null outside of fractals.</summary>
    public FractalLocation? Fractal { get; init; }

    /// <inheritdoc/>
    public bool Equals(CameraState? other) => other is not null && Pose == other.Pose;

    /// <inheritdoc/>
    public override int GetHashCode() => Pose.GetHashCode();
}
