using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Scenes.Lights;

/// <summary>
/// What a light that shines from somewhere brings to any point, whatever its kind: frames, shadow maps and traced images know lights as
/// this only. Made by <see cref="Light.ToEmitter"/>.
/// </summary>
/// <param name="radiance">See <see cref="Radiance"/>.</param>
/// <param name="position">See <see cref="Position"/>.</param>
/// <param name="range">See <see cref="Range"/>.</param>
/// <param name="axis">See <see cref="Axis"/>.</param>
/// <param name="coneAngle">See <see cref="ConeAngle"/>.</param>
/// <param name="diameter">See <see cref="Diameter"/>.</param>
public sealed class Emitter(
    Vector radiance, Vector? position = null, double range = double.PositiveInfinity, Vector axis = default,
    double coneAngle = Emitter.AllAround, double diameter = 0)
{
    /// <summary>The angle of a light that shines in all directions, degrees.</summary>
    public const double AllAround = 360;

    // The widest cone that one depth map holds, degrees. Wider ones take the sides of a cube.
    private const double MaxMapAngle = 110;

    // The part of a cone's angle that has the full light.
    private const double BrightPart = 0.9;

    /// <summary>Linear light: red, green, blue, with the intensity.</summary>
    public Vector Radiance { get; } = radiance;

    /// <summary>Where the light shines from, world space; null where it is parallel.</summary>
    public Vector? Position { get; } = position;

    /// <summary>Radius of the ball around the position that is lit, scene units; infinite for parallel light.</summary>
    public double Range { get; } = range;

    /// <summary>Unit direction in which the light travels, or the axis of its cone; zero where it shines in all directions.</summary>
    public Vector Axis { get; } = axis;

    /// <summary>The full angle of the cone around the axis, degrees; <see cref="AllAround"/> where there is none.</summary>
    public double ConeAngle { get; } = coneAngle;

    /// <summary>Full angle of parallel light as seen from the scene, degrees; 0 where shadows are sharp.</summary>
    public double Diameter { get; } = diameter;

    /// <summary>Cosine of half of that angle.</summary>
    public double DiscCosine { get; } = Math.Cos(diameter * Math.PI / 360);

    /// <summary>True where the light fills a cone only.</summary>
    public bool HasCone => ConeAngle < AllAround;

    /// <summary>True where depth maps of what is lit are the sides of a cube, not a single one.</summary>
    public bool NeedsCube => Position is not null && !(ConeAngle < MaxMapAngle);

    /// <summary>Cosine of the angle with the axis from which on nothing is lit.</summary>
    public double EdgeCosine { get; } = Math.Cos(HalfAngle(coneAngle));

    /// <summary>Cosine of the angle with the axis up to which the light is not weakened.</summary>
    public double BrightCosine { get; } = Math.Cos(BrightPart * HalfAngle(coneAngle));

    /// <summary>Computes the light that falls on a surface which faces it, without shadows. In lighting.glsl it is incomingLight.</summary>
    /// <param name="point">A point of the surface, world space.</param>
    /// <param name="toLight">Unit direction towards the light, or towards the middle of its disc.</param>
    /// <param name="distance">Distance of the light; infinite for parallel light.</param>
    /// <returns>Linear light; 1 shows a white surface white.</returns>
    public Vector Incoming(Vector point, out Vector toLight, out double distance)
    {
        if (Position is not { } position)
        {
            toLight = -Axis;
            distance = double.PositiveInfinity;
            return Radiance;
        }

        var difference = position - point;
        distance = difference.Length();
        toLight = distance > 0 ? difference / distance : Vector.J;
        var strength = Falloff(distance);
        if (HasCone)
        {
            strength *= SmoothStep(EdgeCosine, BrightCosine, -Vector.Dot(toLight, Axis));
        }

        return strength * Radiance;
    }

    private static double HalfAngle(double angle) => 0.5 * angle * Math.PI / 180;

    private static double SmoothStep(double start, double end, double value)
    {
        var t = Math.Clamp((value - start) / (end - start), 0, 1);
        return t * t * (3 - (2 * t));
    }

    /// <summary>By the inverse square, 1 at a tenth of the range, 0 from the range on.</summary>
    private double Falloff(double distance)
    {
        var relative = Math.Max(distance / Range, 1e-4);
        var squared = relative * relative;
        var window = Math.Clamp(1 - (squared * squared), 0, 1);
        return 0.01 / squared * window * window / (0.9999 * 0.9999);
    }
}
