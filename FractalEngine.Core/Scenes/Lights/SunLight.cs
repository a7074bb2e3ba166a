using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Scenes.Lights;

/// <summary>A directional light of some width: shadows are soft in traced images, the softer the farther the object is.</summary>
/// <param name="Direction">The direction in which the light travels, world space, of any length but 0.</param>
/// <param name="Colour">sRGB.</param>
/// <param name="Intensity">Not negative.</param>
/// <param name="Diameter">Full angle of the disc as seen from the scene, degrees, at least 0 and less than 90.</param>
public sealed record SunLight(Vector Direction, Colour Colour, double Intensity, double Diameter = SunLight.DefaultDiameter)
    : DirectionalLight(Direction, Colour, Intensity)
{
    /// <summary>The angle of our own sun, degrees.</summary>
    public const double DefaultDiameter = 0.53;

    /// <inheritdoc/>
    public override IReadOnlyList<object> Declaration => ["sun", Direction, Colour, Intensity, Diameter];

    /// <inheritdoc/>
    public override Emitter? ToEmitter() => new(Radiance, axis: Direction.UnitVector(), diameter: Diameter);
}
