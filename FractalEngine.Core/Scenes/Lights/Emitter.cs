using FractalEngine.Core.Geometry;
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

    /// <summary>Radius of an evenly bright ball around the position, scene units; 0 for none.</summary>
    public double Radius { get; init; }

    /// <summary>From the middle of an evenly bright rectangle to that of a side, world space; zero without a rectangle.</summary>
    public Vector HalfWidth { get; init; }

    /// <summary>Likewise to a side next to that one, so that the cross product of both leads to the front.</summary>
    public Vector HalfHeight { get; init; }

    /// <summary>True where the light comes from a ball or a rectangle, and not from a point or from far away.</summary>
    public bool HasSurface => Radius > 0 || HalfWidth != Vector.Zero;

    /// <summary>
    /// Radiance of that surface, linear light. From far away and straight before it, it brings what a point light brings: π times that of
    /// the light is the irradiance at a tenth of the range, and a surface of the area A, seen as a disc or straight on, at the distance d
    /// brings A/d² of its radiance.
    /// </summary>
    public Vector SurfaceRadiance =>
        HasSurface ? 0.01 * Range * Range / (0.9999 * 0.9999) * Math.PI / SeenArea * Radiance : Vector.Zero;

    /// <summary>The box around that surface, world space; empty without one.</summary>
    public BoundingBox SurfaceBounds =>
        HasSurface && Position is { } middle ? new(middle - Reach, middle + Reach) : BoundingBox.Empty;

    private Vector Reach => HalfWidth.Absolute() + HalfHeight.Absolute() + (Radius * Vector.One);

    private double SeenArea => Radius > 0 ? Math.PI * Radius * Radius : 4 * Vector.Cross(HalfWidth, HalfHeight).Length();

    /// <summary>True where the light fills a cone only.</summary>
    public bool HasCone => ConeAngle < AllAround;

    /// <summary>True where depth maps of what is lit are the sides of a cube, not a single one.</summary>
    public bool NeedsCube => Position is not null && !(ConeAngle < MaxMapAngle);

    /// <summary>Cosine of the angle with the axis from which on nothing is lit.</summary>
    public double EdgeCosine { get; } = Math.Cos(HalfAngle(coneAngle));

    /// <summary>Cosine of the angle with the axis up to which the light is not weakened.</summary>
    public double BrightCosine { get; } = Math.Cos(BrightPart * HalfAngle(coneAngle));

    /// <summary>
    /// Computes the light that falls on a surface which faces it, without shadows. In lighting.glsl it is incomingLight. What shines from a
    /// surface of its own counts as a point.
    /// </summary>
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

    /// <summary>The part of a light with a position that its range leaves, from 1 near it to 0 from the range on.</summary>
    /// <param name="distance">Distance from the position, scene units.</param>
    public double PartWithinRange(double distance)
    {
        var window = Math.Clamp(1 - Math.Pow(distance / Range, 4), 0, 1);
        return window * window;
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
