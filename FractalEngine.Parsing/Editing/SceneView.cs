using FractalEngine.Core.Scenes.Cameras;

namespace FractalEngine.Parsing.Editing;

/// <summary>What a window can change of a scene.</summary>
/// <param name="Camera">The camera in world space.</param>
/// <param name="Projection">The projection of the view.</param>
/// <param name="OrthographicHeight">The visible height in scene units; null where it follows the camera.</param>
public sealed record SceneView(Camera Camera, Projection Projection, double? OrthographicHeight);
