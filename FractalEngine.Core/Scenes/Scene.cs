using System.Collections.Immutable;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Scenes;

/// <summary>
/// All that a scene file says (paper §4.1.5, objective 5), as plain immutable data. Null means that the file leaves it to the
/// program: the camera frames the scene, the aspect ratio follows the window, the planes follow the scene's size.
/// </summary>
public sealed record Scene
{
    /// <summary>The acceleration of free fall near the ground, units a second².</summary>
    public static readonly Vector DefaultGravity = new(0, -9.8, 0);

    /// <summary>Where the scene is seen from.</summary>
    public Camera? Camera { get; init; }

    /// <summary>Perspective unless the scene says otherwise.</summary>
    public Projection Projection { get; init; }

    /// <summary>
    /// The height that an orthographic picture shows, scene units; null for what perspective shows at the depth of
    /// the scene's centre.
    /// </summary>
    public double? OrthographicHeight { get; init; }

    /// <summary>Width divided by height of the picture.</summary>
    public double? Aspect { get; init; }

    /// <summary>The depths between which things are drawn, scene units.</summary>
    public (double Near, double Far)? Clip { get; init; }

    /// <summary>What is behind everything.</summary>
    public Colour? Background { get; init; }

    /// <summary>In the order of the file; where there are none, a default light is used.</summary>
    public ImmutableArray<Light> Lights { get; init; } = [];

    /// <summary>In the order of the file, physics objects among them.</summary>
    public ImmutableArray<SceneObject> Objects { get; init; } = [];

    /// <summary>Acceleration of all bodies, units a second².</summary>
    public Vector Gravity { get; init; } = DefaultGravity;

    /// <summary>Who walks in the scene, if anyone.</summary>
    public Player? Player { get; init; }

    /// <inheritdoc/>
    public bool Equals(Scene? other) =>
        other is not null && Camera == other.Camera && Projection == other.Projection
        && OrthographicHeight.Equals(other.OrthographicHeight) && Aspect.Equals(other.Aspect) && Clip.Equals(other.Clip)
        && Background == other.Background && Lights.SequenceEqual(other.Lights) && Objects.SequenceEqual(other.Objects)
        && Gravity == other.Gravity && Player == other.Player;

    /// <inheritdoc/>
    public override int GetHashCode() =>
        HashCode.Combine(Camera, Projection, OrthographicHeight, Aspect, Clip, Background, Lights.Length, Objects.Length);
}
