using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Fractals.Descriptions;

/// <summary>A colour that a map mixes into all that it makes. Without an amount it changes nothing.</summary>
/// <remarks>
/// Mixing is affine in linear light: what has the colour c gets the colour (1 − a)·c + a·C, the maps nearest to it first. Hues are not
/// turned, so that the mean of what a fractal shows obeys the same rule, level by level.
/// </remarks>
/// <param name="Colour">The colour C, sRGB.</param>
/// <param name="Amount">The part a of it in the mixture, from 0 to 1.</param>
public readonly record struct MapColour(Colour Colour, double Amount)
{
    /// <summary>True where nothing is mixed in.</summary>
    public bool IsNone => Amount == 0;

    /// <summary>The colour that a map and one within it mix in together.</summary>
    /// <param name="inner">That of the map within, which comes first.</param>
    public MapColour Over(MapColour inner)
    {
        if (IsNone || inner.IsNone)
        {
            return IsNone ? inner : this;
        }

        var amount = 1 - ((1 - Amount) * (1 - inner.Amount));
        var mixed = Mix((inner.Amount / amount) * inner.Colour.ToLinearVector(), 1 / amount);
        return new(new Colour(mixed.X, mixed.Y, mixed.Z).FromLinear(), amount);
    }

    /// <summary>Mixes the colour into linear light.</summary>
    /// <param name="light">The light that has the share 1 − a.</param>
    /// <param name="weight">The weight of the colour, relative to its amount.</param>
    public Vector Mix(Vector light, double weight = 1) => ((1 - Amount) * light) + (weight * Amount * Colour.ToLinearVector());
}
