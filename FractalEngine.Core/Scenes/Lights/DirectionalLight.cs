using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Scenes.Lights;

/// <summary>Parallel light from infinitely far away, such as sunlight.</summary>
/// <param name="Direction">The direction in which the light travels, world space, of any length but 0.</param>
/// <param name="Colour">sRGB.</param>
/// <param name="Intensity">Not negative.</param>
public record DirectionalLight(Vector Direction, Colour Colour, double Intensity) : Light(Colour, Intensity)
{
    /// <summary>The direction in which the light travels, world space, of any length but 0.</summary>
    /// <exception cref="ArgumentException">The direction is (0, 0, 0) or not finite.</exception>
    public Vector Direction
    {
        get;
        init => field = RequireDirection(value, nameof(Direction));
    } = RequireDirection(Direction, nameof(Direction));

    /// <inheritdoc/>
    public override IReadOnlyList<object> Declaration => ["light", "directional", Direction, Colour, Intensity];

    /// <inheritdoc/>
    public override Emitter? ToEmitter() => new(Radiance, axis: Direction.UnitVector());
}
