using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Core.Views;

namespace FractalEngine.Render.Cameras;

/// <summary>Frames a scene: finds the cameras that show the whole of it.</summary>
/// <param name="bounds">Bounds of the scene in world space.</param>
/// <param name="scene">The scene to frame; null to frame its bounds.</param>
public sealed class SceneFraming(BoundingBox bounds, LoadedScene? scene)
{
    // How far a framing camera may stand from where it should, divided by its distance: framing leaves a fifth of the frame free.
    private const double MaxDrift = 0.2;

    private readonly BoundingBox _bounds = bounds.IsEmpty ? new(-Vector.One, Vector.One) : bounds;

    /// <summary>The diagonal of the scene in scene units, never 0.</summary>
    public double Extent => Math.Max(_bounds.Diagonal, 1e-9 * (1 + _bounds.Centre.MaxAbsComponent()));

    /// <summary>Returns how far ahead the middle of the scene is; where it is not ahead, the diagonal.</summary>
    public double DistanceToCentre(Camera camera)
    {
        var depth = camera.ToCameraSpace(_bounds.Centre).Z;
        return depth > 1e-3 * Extent ? depth : Extent;
    }

    /// <summary>Returns the camera in the same direction that shows the whole scene.</summary>
    /// <param name="camera">A camera in world space, whose position is not used.</param>
    /// <param name="projection">The projection of the view.</param>
    /// <param name="aspect">Width divided by height of the frame.</param>
    public (Camera Camera, double? OrthographicHeight) Frame(Camera camera, Projection projection, double aspect)
    {
        if (scene is null)
        {
            return (CameraFraming.Frame(camera, _bounds, aspect), null);
        }

        var framed = CameraFraming.FrameScene(camera, scene, aspect);
        return projection == Projection.Orthographic ? CameraFraming.FrameSceneOrthographic(framed, scene, aspect) : (framed, null);
    }

    /// <summary>Tells whether a camera that has framed a scene stands elsewhere, by a fifth of its distance, than one for this.</summary>
    /// <param name="camera">The camera in world space.</param>
    /// <param name="projection">The projection of the view.</param>
    /// <param name="orthographicHeight">The visible height in scene units; null where it follows the camera.</param>
    /// <param name="aspect">Width divided by height of the frame that it was framed for.</param>
    public bool HasDrifted(Camera camera, Projection projection, double? orthographicHeight, double aspect)
    {
        var (framed, height) = Frame(camera, projection, aspect);
        var drift = camera.LocalAxesInverse * (framed.Position - camera.Position);
        return height is { } wanted
            ? Math.Max(Math.Max(Math.Abs(drift.X), Math.Abs(drift.Y)), Math.Abs(wanted - (orthographicHeight ?? 0))) > MaxDrift * wanted
            : drift.Length() > MaxDrift * DistanceToCentre(framed);
    }
}
