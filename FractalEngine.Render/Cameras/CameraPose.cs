using FractalEngine.Core.Scenes.Cameras;

namespace FractalEngine.Render.Cameras;

/// <summary>The state of a camera that can be moved. Two equal poses show the same view.</summary>
/// <param name="Camera">The camera in world space; within a fractal only its rotation and its angle of view are used.</param>
/// <param name="Projection">The projection of the view.</param>
/// <param name="OrthographicHeight">The visible height in scene units; null where it follows the camera.</param>
/// <param name="MoveCount">The number of moves within a fractal, whose positions the camera itself does not hold.</param>
public sealed record CameraPose(Camera Camera, Projection Projection, double? OrthographicHeight, long MoveCount)
{
    /// <summary>
    /// Width divided by height of the frame that the whole scene was framed for, and the camera not moved since; null for all other views.
    /// </summary>
    public double? FramedAspect { get; init; }
}
