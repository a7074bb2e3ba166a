using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Scenes.Lights;

/// <summary>An evenly bright ball. It lights what is far away as a point light of the same numbers at its centre does.</summary>
/// <param name="Position">The centre, world space, scene units.</param>
/// <param name="Radius">Scene units, more than 0: from 1e-6 to 1e6 of the range.</param>
/// <param name="Colour">sRGB.</param>
/// <param name="Intensity">As for a point light.</param>
/// <param name="Range">As for a point light, from the centre.</param>
public sealed record BallLight(Vector Position, double Radius, Colour Colour, double Intensity, double Range)
    : PointLight(Position, Colour, Intensity, Range)
{
    /// <inheritdoc/>
    public override IReadOnlyList<object> Declaration => ["light", "ball", Position, Radius, Colour, Intensity, Range];

    /// <inheritdoc/>
    public override Emitter? ToEmitter() => new(Radiance, Position, Range) { Radius = Radius };
}
