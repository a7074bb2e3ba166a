using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes.Cameras;

namespace FractalEngine.Core.Scenes.Films;

/// <summary>The camera of a film at one of its times.</summary>
/// <param name="Time">Seconds since the beginning of the film.</param>
/// <param name="Camera">
/// Position, angles and angle of view. Its handedness says nothing: the film is shown with that of its scene.
/// </param>
public sealed record CameraKey(double Time, Camera Camera) : FilmKey(Time)
{
    /// <summary>Largest coordinate of a camera, with which products along its way stay doubles.</summary>
    public const double MaxCoordinate = 1e150;

    /// <summary>
    /// Point that the camera looks at, in place of its angles, and the direction that is up; null where the angles count.
    /// </summary>
    public (Vector Point, Vector Up)? Target { get; init; }

    /// <inheritdoc/>
    public override IReadOnlyList<object> Declaration => Target is not var (point, up)
        ? ["c", Camera.Position, Camera.Rotation, Camera.FieldOfView, .. Lens]
        : ["c", Camera.Position, "look-at", point, .. up == Vector.J ? (object[])[] : ["up", up], Camera.FieldOfView, .. Lens];

    private IEnumerable<object> Lens =>
    [
        .. Camera.Aperture == 0 ? (object[])[] : ["aperture", Camera.Aperture],
        .. Camera.FocusDepth == 1 ? (object[])[] : ["focus", Camera.FocusDepth],
    ];

    /// <inheritdoc/>
    public override bool IsOfSame(FilmKey other) => other is CameraKey;
}
