using FractalEngine.Core.Geometry;

namespace FractalEngine.Core.Scenes.Lights;

/// <summary>Light that falls equally from all directions.</summary>
/// <param name="Colour">sRGB.</param>
/// <param name="Intensity">Not negative.</param>
public sealed record AmbientLight(Colour Colour, double Intensity) : Light(Colour, Intensity)
{
    /// <inheritdoc/>
    public override IReadOnlyList<object> Declaration => ["light", "ambient", Colour, Intensity];

    /// <inheritdoc/>
    public override Emitter? ToEmitter() => null;
}
