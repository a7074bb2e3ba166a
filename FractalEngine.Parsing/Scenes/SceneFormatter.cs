using System.Globalization;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;

namespace FractalEngine.Parsing.Scenes;

/// <summary>Writes the declarations of a scene, numbers in the shortest form that reads back to the same bits.</summary>
internal static class SceneFormatter
{
    /// <summary>The kinds in the order in which a new scene file declares them.</summary>
    public static IReadOnlyList<SceneDeclarationKind> Kinds { get; } = Enum.GetValues<SceneDeclarationKind>();

    /// <summary>How many declarations of a kind a scene needs.</summary>
    public static int Count(Scene scene, SceneDeclarationKind kind) => kind switch
    {
        SceneDeclarationKind.Light => scene.Lights.Length,
        SceneDeclarationKind.SceneObject => scene.Objects.Length,
        _ => Format(scene, kind, 0) is null ? 0 : 1,
    };

    /// <summary>One declaration without its line break; null when the scene does not need it.</summary>
    public static string? Format(Scene scene, SceneDeclarationKind kind, int index) => kind switch
    {
        SceneDeclarationKind.Camera => scene.Camera is { } camera
            ? $"c {camera.Position} {camera.Rotation} {Text(camera.FieldOfView)}" : null,
        SceneDeclarationKind.Projection => scene switch
        {
            { Projection: Projection.Perspective } => null,
            { OrthographicHeight: { } height } => $"projection orthographic {Text(height)}",
            _ => "projection orthographic",
        },
        SceneDeclarationKind.Aspect => scene.Aspect is { } aspect ? $"aspect {Text(aspect)}" : null,
        SceneDeclarationKind.Clip => scene.Clip is var (near, far) ? $"clip {Text(near)} {Text(far)}" : null,
        SceneDeclarationKind.Background => scene.Background is { } background ? $"background {background}" : null,
        SceneDeclarationKind.Gravity => AreSame(scene.Gravity, Scene.DefaultGravity) ? null : $"gravity {scene.Gravity}",
        SceneDeclarationKind.Player => scene.Player is { } player ? Format(player) : null,
        SceneDeclarationKind.Light => index < scene.Lights.Length ? Format(scene.Lights[index]) : null,
        SceneDeclarationKind.SceneObject => index < scene.Objects.Length ? Format(scene.Objects[index]) : null,
        _ => throw new ArgumentOutOfRangeException(nameof(kind)),
    };

    private static string Format(Light light) => light switch
    {
        AmbientLight => $"light ambient {light.Colour} {Text(light.Intensity)}",
        DirectionalLight directional => $"light directional {directional.Direction} {light.Colour} {Text(light.Intensity)}",
        SpotLight spot => $"light spot {spot.Position} {spot.Direction} {Text(spot.Angle)} {light.Colour} {Text(light.Intensity)} {Text(spot.Range)}",
        PointLight point => $"light point {point.Position} {light.Colour} {Text(light.Intensity)} {Text(point.Range)}",
        _ => throw new ArgumentOutOfRangeException(nameof(light)),
    };

    private static string Format(Player player) => Join(
        $"player {player.Position} {Text(player.Radius)} {Text(player.Height)}",
        player.Speed is { } speed ? $"speed {Text(speed)}" : null,
        player.Jump is { } jump ? $"jump {Text(jump)}" : null,
        AreSame(player.Slope, Player.DefaultSlope) ? null : $"slope {Text(player.Slope)}",
        player.Step is { } step ? $"step {Text(step)}" : null);

    private static string Format(SceneObject declared)
    {
        var body = declared as PhysicsObject;
        return Join(
            body is not null ? "p" : "o",
            $"\"{declared.File}\"",
            Format(declared.Placement),
            body is { Restitution: var restitution } ? Text(restitution) : null,
            declared.Name is { } name ? $"name \"{name}\"" : null,
            declared.Colour is { } colour ? $"colour {colour}" : null,
            declared.Gradient is { } gradient ? $"gradient {(gradient.By == GradientKind.Level ? "level" : "path")} {gradient.To}" : null,
            body is { Velocity: var velocity } && !AreSame(velocity, Vector.Zero) ? $"velocity {velocity}" : null,
            body is { Mass: not 1.0 and var mass } ? $"mass {Text(mass)}" : null,
            body is { Friction: var friction } && !AreSame(friction, 0) ? $"friction {Text(friction)}" : null,
            body is { Damping: var damping } && !AreSame(damping, 0) ? $"damping {Text(damping)}" : null,
            body is not null ? FormatShrinkage(body.Shrinkage, body.MinimumScale) : null,
            body is { Collider: not ColliderKind.Exact and var collider } ? $"collider {SceneParser.NameOf(collider)}" : null);
    }

    private static string? FormatShrinkage(double rate, double minimum) => (AreSame(rate, 0), AreSame(minimum, PhysicsObject.DefaultMinimumScale)) switch
    {
        (true, true) => null,
        (false, true) => $"shrink {Text(rate)}",
        (_, false) => $"shrink {Text(rate)} {Text(minimum)}",
    };

    private static string Join(params string?[] parts) => string.Join(' ', parts.Where(part => part is not null));

    private static string Format(Transformation placement) =>
        (Format(placement.Position, Vector.Zero), Format(placement.Rotation, Vector.Zero), Format(placement.Scale, Vector.One)) switch
        {
            ("#", "#", "#") => "#",
            var (position, rotation, scale) => $"({position}, {rotation}, {scale})",
        };

    private static string Format(Vector vector, Vector neutral) => AreSame(vector, neutral) ? "#" : vector.ToString();

    /// <summary>Bit for bit: −0 is not 0 here.</summary>
    private static bool AreSame(Vector v1, Vector v2) => v1.ToString() == v2.ToString();

    private static bool AreSame(double number1, double number2) => BitConverter.DoubleToInt64Bits(number1) == BitConverter.DoubleToInt64Bits(number2);

    private static string Text(double number) => number.ToString("R", CultureInfo.InvariantCulture);
}
