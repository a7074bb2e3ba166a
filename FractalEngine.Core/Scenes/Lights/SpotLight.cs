using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Scenes.Lights;

/// <summary>A point light that shines into a cone, with a soft edge over the outer tenth of its angle.</summary>
/// <param name="Position">World space, scene units.</param>
/// <param name="Direction">The axis of the cone, away from the light, world space.</param>
/// <param name="Angle">The full angle of the cone in degrees, between 0 and 180.</param>
/// <param name="Colour">sRGB.</param>
/// <param name="Intensity">As for a point light.</param>
/// <param name="Range">As for a point light.</param>
public sealed record SpotLight(Vector Position, Vector Direction, double Angle, Colour Colour, double Intensity, double Range)
    : PointLight(Position, Colour, Intensity, Range)
{
    /// <summary>The axis of the cone, in which the light travels, world space, of any length but 0.</summary>
    /// <exception cref="ArgumentException">The direction is (0, 0, 0) or not finite.</exception>
    public Vector Direction
    {
        get;
        init => field = RequireDirection(value, nameof(Direction));
    } = RequireDirection(Direction, nameof(Direction));

    /// <inheritdoc/>
    public override IReadOnlyList<object> Declaration => ["light", "spot", Position, Direction, Angle, Colour, Intensity, Range];

    /// <inheritdoc/>
    public override Emitter? ToEmitter() => new(Radiance, Position, Range, Direction.UnitVector(), Angle);
}
