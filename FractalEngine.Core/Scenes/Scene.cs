using System.Collections.Immutable;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Core.Scenes.Films;
using FractalEngine.Core.Scenes.Lights;

namespace FractalEngine.Core.Scenes;

/// <summary>
/// Objects, lights, camera and player of a scene (paper §4.1.5, objective 5), as plain immutable data. Null leaves a choice to the
/// program: the camera frames the scene, the aspect ratio follows the window, the planes follow the scene's size.
/// </summary>
public sealed record Scene
{
    /// <summary>The acceleration of free fall near the ground, units a second².</summary>
    public static readonly Vector DefaultGravity = new(0, -9.8, 0);

    /// <summary>The camera that shows the scene, with the scene's handedness; null for one that frames it.</summary>
    public Camera? Camera
    {
        get;
        init => field = WithHandedness(value, Handedness);
    }

    /// <summary>How the scene's coordinates are shown; left unless stated otherwise. The camera takes it over.</summary>
    public Handedness Handedness
    {
        get;
        init
        {
            field = value;
            Camera = WithHandedness(Camera, value);
        }
    }

    /// <summary>The projection of the camera; perspective unless stated otherwise.</summary>
    public Projection Projection { get; init; }

    /// <summary>
    /// The height that an orthographic image shows, scene units; null for what perspective shows at the depth of the scene's centre.
    /// </summary>
    public double? OrthographicHeight { get; init; }

    /// <summary>Width divided by height of the image; null for that of the window.</summary>
    public double? Aspect { get; init; }

    /// <summary>Depths of the near and the far plane, scene units; null to follow the size of the scene.</summary>
    public (double Near, double Far)? Clip { get; init; }

    /// <summary>The colour behind everything; null for the default.</summary>
    public Colour? Background { get; init; }

    /// <summary>The sky, seen behind everything where there is no <see cref="Background"/>, and a light; null for none.</summary>
    public Sky? Sky { get; init; }

    /// <summary>
    /// Where a reflection probe stands, whose view to all sides drawn mirrors show, world space; null for mirrors of the light from all
    /// around alone.
    /// </summary>
    /// <exception cref="ArgumentException">A coordinate is NaN or infinite.</exception>
    public Vector? Probe
    {
        get;
        init => field = value?.IsFinite() != false ? value : throw new ArgumentException("expected a finite position", nameof(Probe));
    }

    /// <summary>Factor of all light before it is shown, positive.</summary>
    /// <exception cref="ArgumentException">The factor is not positive and finite.</exception>
    public double Exposure
    {
        get;
        init => field = value is > 0 and < double.PositiveInfinity
            ? value
            : throw new ArgumentException("expected a positive and finite exposure", nameof(Exposure));
    } = 1;

    /// <summary>Whether images find their exposure by what they show, times <see cref="Exposure"/>.</summary>
    public bool HasAutoExposure { get; init; }

    /// <summary>How light becomes what the screen shows; as it is unless stated otherwise.</summary>
    public Tone Tone { get; init; }

    /// <summary>Haze between the eye and surfaces; null for clear air.</summary>
    public Fog? Fog { get; init; }

    /// <summary>The lights, in the order of the file; a scene without any and without a sky gets default lights.</summary>
    public ImmutableArray<Light> Lights { get; init; } = [];

    /// <summary>The objects, in the order of the file, physics objects among them.</summary>
    public ImmutableArray<SceneObject> Objects { get; init; } = [];

    /// <summary>The acceleration of all bodies, units a second².</summary>
    public Vector Gravity { get; init; } = DefaultGravity;

    /// <summary>The player who walks in the scene; null for none.</summary>
    public Player? Player { get; init; }

    /// <summary>How camera and numbers change in the course of time; null for a scene without a film.</summary>
    public Film? Film { get; init; }

    /// <inheritdoc/>
    public bool Equals(Scene? other) =>
        other is not null && Camera == other.Camera && Projection == other.Projection
        && OrthographicHeight.Equals(other.OrthographicHeight) && Aspect.Equals(other.Aspect) && Clip.Equals(other.Clip)
        && Background == other.Background && Sky == other.Sky && Probe == other.Probe
        && Exposure.Equals(other.Exposure) && Tone == other.Tone && HasAutoExposure == other.HasAutoExposure
        && Fog == other.Fog && Lights.SequenceEqual(other.Lights) && Objects.SequenceEqual(other.Objects)
        && Gravity == other.Gravity && Player == other.Player && Film == other.Film && Handedness == other.Handedness;

    /// <inheritdoc/>
    public override int GetHashCode() =>
        HashCode.Combine(Camera, Projection, OrthographicHeight, Aspect, Clip, Background, Lights.Length, Objects.Length);

    private static Camera? WithHandedness(Camera? camera, Handedness handedness) =>
        camera is null || camera.Handedness == handedness ? camera : camera with { Handedness = handedness };
}
