using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Scenes.Lights;

/// <summary>Light from a point, which falls with the square of the distance and smoothly ends at its range.</summary>
/// <param name="Position">World space, scene units.</param>
/// <param name="Colour">sRGB.</param>
/// <param name="Intensity">The light that falls on a surface at a tenth of the range.</param>
/// <param name="Range">Scene units; nothing farther away is lit.</param>
public record PointLight(Vector Position, Colour Colour, double Intensity, double Range) : Light(Colour, Intensity)
{
    /// <inheritdoc/>
    public override IReadOnlyList<object> Declaration => ["light", "point", Position, Colour, Intensity, Range];

    /// <inheritdoc/>
    public override Emitter? ToEmitter() => new(Radiance, Position, Range);
}
