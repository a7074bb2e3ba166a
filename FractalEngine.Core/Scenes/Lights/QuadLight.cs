using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Scenes.Lights;

/// <summary>
/// An evenly bright rectangle that shines to its front. It lights what is far before it as a point light of the same numbers does, and
/// what is at an angle by its cosine.
/// </summary>
/// <param name="Position">The centre, world space, scene units.</param>
/// <param name="Direction">Straight away from the front, world space, of any length but 0.</param>
/// <param name="Width">Length of the level sides, scene units, more than 0: from 1e-6 to 1e6 of the range.</param>
/// <param name="Height">Length of the other sides, likewise.</param>
/// <param name="Colour">sRGB.</param>
/// <param name="Intensity">As for a point light, straight before the rectangle.</param>
/// <param name="Range">As for a point light, from the centre.</param>
/// <param name="Turn">
/// Angle from the level direction to the width, degrees: towards the height, which leads up. Where the rectangle faces straight up or down
/// the level direction is x.
/// </param>
public sealed record QuadLight(
    Vector Position, Vector Direction, double Width, double Height, Colour Colour, double Intensity, double Range, double Turn = 0)
    : PointLight(Position, Colour, Intensity, Range)
{
    /// <summary>Straight away from the front, in which the light travels, world space, of any length but 0.</summary>
    /// <exception cref="ArgumentException">The direction is (0, 0, 0) or not finite.</exception>
    public Vector Direction
    {
        get;
        init => field = RequireDirection(value, nameof(Direction));
    } = RequireDirection(Direction, nameof(Direction));

    /// <inheritdoc/>
    public override IReadOnlyList<object> Declaration => [
        "light", "quad", Position, Direction, Width, Height, Colour, Intensity, Range, .. 1 / Turn < 0 || Turn > 0 ? (object[])[Turn] : []];

    /// <inheritdoc/>
    public override Emitter? ToEmitter()
    {
        var axis = Direction.UnitVector();
        var level = Vector.Cross(Vector.J, axis);
        level = level == Vector.Zero ? Vector.I : level.UnitVector();
        var up = Vector.Cross(axis, level);
        var (sine, cosine) = Math.SinCos(Turn * Math.PI / 180);
        return new(Radiance, Position, Range, axis)
        {
            HalfWidth = 0.5 * Width * ((cosine * level) + (sine * up)),
            HalfHeight = 0.5 * Height * ((cosine * up) - (sine * level)),
        };
    }
}
