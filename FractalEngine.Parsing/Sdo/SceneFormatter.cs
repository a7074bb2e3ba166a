using System.Globalization;
using FractalEngine.Core.Colliders;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Core.Scenes.Films;
using FractalEngine.Core.Scenes.Lights;

namespace FractalEngine.Parsing.Sdo;

/// <summary>Formats the declarations of a scene. Numbers have the shortest form that reads back to the same bits.</summary>
internal static class SceneFormatter
{
    /// <summary>Kinds of declarations in the order of a new scene file.</summary>
    public static IReadOnlyList<SceneDeclarationKind> Kinds { get; } = Enum.GetValues<SceneDeclarationKind>();

    /// <summary>Returns the number of declarations of a kind that a scene needs.</summary>
    public static int DeclarationCount(Scene scene, SceneDeclarationKind kind) => kind switch
    {
        SceneDeclarationKind.Light => scene.Lights.Length,
        SceneDeclarationKind.SceneObject => scene.Objects.Length,
        SceneDeclarationKind.FilmKey => scene.Film?.Keys.Length ?? 0,
        _ => Format(scene, kind, 0) is null ? 0 : 1,
    };

    /// <summary>Formats one declaration without its line break; null if the scene does not need it.</summary>
    public static string? Format(Scene scene, SceneDeclarationKind kind, int index) => kind switch
    {
        SceneDeclarationKind.Handedness => scene.Handedness == Handedness.Right ? "handed right" : null,
        SceneDeclarationKind.Camera => scene.Camera is { } camera ? Format(camera) : null,
        SceneDeclarationKind.Projection => scene switch
        {
            { Projection: Projection.Perspective } => null,
            { OrthographicHeight: { } height } => $"projection orthographic {FormatNumber(height)}",
            _ => "projection orthographic",
        },
        SceneDeclarationKind.Aspect => scene.Aspect is { } aspect ? $"aspect {FormatNumber(aspect)}" : null,
        SceneDeclarationKind.Clip => scene.Clip is var (near, far) ? $"clip {FormatNumber(near)} {FormatNumber(far)}" : null,
        SceneDeclarationKind.Background => scene.Background is { } background ? $"background {background}" : null,
        SceneDeclarationKind.Sky => scene.Sky is { } sky ? Format(sky.Declaration) : null,
        SceneDeclarationKind.Probe => scene.Probe is { } probe ? $"probe {probe}" : null,
        SceneDeclarationKind.Exposure => AreBitEqual(scene.Exposure, 1)
            ? (scene.HasAutoExposure ? "exposure auto" : null)
            : $"exposure {(scene.HasAutoExposure ? "auto " : "")}{FormatNumber(scene.Exposure)}",
        SceneDeclarationKind.Tone => scene.Tone == Tone.None ? null : $"tone {scene.Tone.ToString().ToLowerInvariant()}",
        SceneDeclarationKind.Fog => scene.Fog is { } fog ? Format(fog) : null,
        SceneDeclarationKind.Gravity => AreBitEqual(scene.Gravity, Scene.DefaultGravity) ? null : $"gravity {scene.Gravity}",
        SceneDeclarationKind.Player => scene.Player is { } player ? Format(player) : null,
        SceneDeclarationKind.Film => scene.Film is { } film ? $"film {FormatNumber(film.Duration)}" : null,
        SceneDeclarationKind.FilmKey => scene.Film is { Keys: var keys } && index < keys.Length ? Format(keys[index]) : null,
        SceneDeclarationKind.Light => index < scene.Lights.Length ? Format(scene.Lights[index].Declaration) : null,
        SceneDeclarationKind.SceneObject => index < scene.Objects.Length ? Format(scene.Objects[index]) : null,
        _ => throw new ArgumentOutOfRangeException(nameof(kind)),
    };

    /// <summary>Formats the line of a key: its time, a camera or a number, and the ease.</summary>
    public static string Format(FilmKey key) => Join(
        $"at {FormatNumber(key.Time)} {Format(key.Declaration)}", key.Ease == Ease.Linear ? null : $"ease {FilmParser.WordOf(key.Ease)}");

    private static string Format(Camera camera) => Join(
        $"c {camera.Position} {camera.Rotation} {FormatNumber(camera.FieldOfView)}",
        AreBitEqual(camera.Aperture, 0) ? null : $"aperture {FormatNumber(camera.Aperture)}",
        AreBitEqual(camera.FocusDepth, 1) ? null : $"focus {FormatNumber(camera.FocusDepth)}");

    private static string Format(IReadOnlyList<object> declaration) =>
        string.Join(' ', declaration.Select(static word => Convert.ToString(word, CultureInfo.InvariantCulture)));

    private static string Format(Fog fog) => Join(
        $"fog {FormatNumber(fog.Density)}", fog.Colour?.ToString(),
        AreBitEqual(fog.Albedo, 0) ? null : $"scatter {FormatNumber(fog.Albedo)}",
        AreBitEqual(fog.Anisotropy, 0) ? null : $"forward {FormatNumber(fog.Anisotropy)}");

    private static string Format(Player player) => Join(
        $"player {player.Position} {FormatNumber(player.Radius)} {FormatNumber(player.Height)}",
        player.WalkingSpeedOverride is { } speed ? $"speed {FormatNumber(speed)}" : null,
        player.JumpSpeedOverride is { } jump ? $"jump {FormatNumber(jump)}" : null,
        AreBitEqual(player.MaxSlopeAngle, Player.DefaultMaxSlopeAngle) ? null : $"slope {FormatNumber(player.MaxSlopeAngle)}",
        player.StepHeightOverride is { } step ? $"step {FormatNumber(step)}" : null);

    private static string Format(SceneObject declared)
    {
        var body = declared as PhysicsObject;
        return Join(
            body is not null ? "p" : "o",
            $"\"{declared.File}\"",
            Format(declared.Placement),
            body is { Restitution: var restitution } ? FormatNumber(restitution) : null,
            declared.Name is { } name ? $"name \"{name}\"" : null,
            declared.Colour is { } colour ? $"colour {colour}" : null,
            declared.Gradient is { } gradient ? Format(gradient) : null,
            body is null && declared.Motion is { } motion ? Format(motion) : null,
            body is null && declared.Belt is var belt && !AreBitEqual(belt, Vector.Zero) ? $"belt {belt}" : null,
            body is { Velocity: var velocity } && !AreBitEqual(velocity, Vector.Zero) ? $"velocity {velocity}" : null,
            body is { Mass: not 1.0 } or { Shape.IsMesh: true, IsMassStated: true } ? $"mass {FormatNumber(body.Mass)}" : null,
            body is { Density: { } density } ? $"density {FormatNumber(density)}" : null,
            body is { Friction: var friction } && !AreBitEqual(friction, 0) ? $"friction {FormatNumber(friction)}" : null,
            body is { RollingFriction: var rolling } && !AreBitEqual(rolling, 0) ? $"rolling {FormatNumber(rolling)}" : null,
            body is { SpinningFriction: var spinning } && !AreBitEqual(spinning, 0) ? $"spinning {FormatNumber(spinning)}" : null,
            body is { InertiaFactor: not PhysicsObject.SolidInertiaFactor and var inertia } ? $"inertia {FormatNumber(inertia)}" : null,
            body is { Shape: var shape } ? FormatShape(shape) : null,
            body is { IsRotationLocked: true } ? "rotation locked" : null,
            body is { Damping: var damping } && !AreBitEqual(damping, 0) ? $"damping {FormatNumber(damping)}" : null,
            body is not null ? FormatShrinkage(body.Shrinkage, body.MinScale) : null,
            body is { Collider: not ColliderKind.Exact and var collider } ? $"collider {ColliderNames.Of(collider)}" : null);
    }

    private static string Format(ObjectMotion motion)
    {
        var hasVelocity = !AreBitEqual(motion.Velocity, Vector.Zero) || AreBitEqual(motion.Spin, Vector.Zero);
        return Join(
            "moving",
            hasVelocity ? $"velocity {motion.Velocity}" : null,
            AreBitEqual(motion.Spin, Vector.Zero) ? null : $"spin {motion.Spin}",
            motion is { From: { } from, To: { } to } ? $"from {from} to {to}" : null);
    }

    /// <summary>The word by which scenes call a kind of gradients.</summary>
    public static string WordOf(GradientKind kind) => kind.ToString().ToLowerInvariant();

    private static string Format(Gradient gradient) => Join(
        $"gradient {WordOf(gradient.Kind)}", FormatColours(gradient), Format("roughness", gradient.Roughness),
        Format("metal", gradient.Metalness), Format("glow", gradient.Glow));

    private static string? Format(string word, GradientRange? range) =>
        range is var (first, last) ? $"{word} {FormatNumber(first)} {FormatNumber(last)}" : null;

    private static string FormatColours(Gradient gradient) => gradient.Palette switch
    {
        null => gradient.EndColour.ToString(),
        { Name: { } name } => $"\"{name}\"",
        { IsEven: var isEven, Stops: var stops } => string.Join(
            ' ', stops.Select(stop => isEven ? stop.Colour.ToString() : $"{FormatNumber(stop.Position)} {stop.Colour}")),
    };

    private static string? FormatShape(BodyShape shape) =>
        shape.IsMesh ? "shape mesh"
        : shape.IsCapsule ? "shape capsule"
        : shape.BallCount > 0 ? $"shape balls {FormatNumber(shape.BallCount)}" : null;

    private static string? FormatShrinkage(double rate, double minimum)
    {
        if (!AreBitEqual(minimum, PhysicsObject.DefaultMinScale))
        {
            return $"shrink {FormatNumber(rate)} {FormatNumber(minimum)}";
        }

        return AreBitEqual(rate, 0) ? null : $"shrink {FormatNumber(rate)}";
    }

    private static string Join(params string?[] parts) => string.Join(' ', parts.Where(part => part is not null));

    private static string Format(Transformation placement)
    {
        var position = Format(placement.Position, Vector.Zero);
        var rotation = Format(placement.Rotation, Vector.Zero);
        var scale = Format(placement.Scale, Vector.One);
        return position == "#" && rotation == "#" && scale == "#" ? "#" : $"({position}, {rotation}, {scale})";
    }

    private static string Format(Vector vector, Vector defaultValue) => AreBitEqual(vector, defaultValue) ? "#" : vector.ToString();

    /// <summary>Compares vectors bit for bit, so that −0 differs from 0.</summary>
    private static bool AreBitEqual(Vector v1, Vector v2) => v1.ToString() == v2.ToString();

    private static bool AreBitEqual(double number1, double number2) =>
        BitConverter.DoubleToInt64Bits(number1) == BitConverter.DoubleToInt64Bits(number2);

    private static string FormatNumber(double number) => number.ToString("R", CultureInfo.InvariantCulture);
}
