using FractalEngine.Core.Geometry;

namespace FractalEngine.Core.Scenes.Lights;

/// <summary>Even haze between the eye and surfaces. It may scatter the light of suns and lamps, which shows as shafts.</summary>
/// <param name="Density">
/// Share of light that is lost in a unit of distance, where that is small: after d units, e^(−density·d) of it are left.
/// </param>
/// <param name="Colour">Colour of what replaces it, sRGB; null for the sky's horizon, or the background without a sky.</param>
public sealed record Fog(double Density, Colour? Colour = null)
{
    /// <summary>Largest absolute value of <see cref="Anisotropy"/>.</summary>
    public const double MaxAnisotropy = 0.95;

    /// <summary>
    /// Share of the light of suns and lamps that is scattered where it is lost, from 0 to 1. It is added to <see cref="Colour"/>, which
    /// stands for light from all around.
    /// </summary>
    public double Albedo { get; init; }

    /// <summary>
    /// Mean cosine of the angle by which light is deflected, from −<see cref="MaxAnisotropy"/> to <see cref="MaxAnisotropy"/>: 0 where it
    /// goes on in all directions alike, larger where the air is bright around the sun.
    /// </summary>
    public double Anisotropy { get; init; }

    /// <summary>Whether light is scattered in the air.</summary>
    public bool IsLit => Density > 0 && Albedo > 0;

    /// <summary>Computes how densely scattered light goes on in a direction (L. Henyey and J. Greenstein, 1941).</summary>
    /// <param name="cosine">Cosine of the angle by which the light is deflected.</param>
    /// <returns>Share of it for each unit of solid angle; over all directions it adds up to 1.</returns>
    public double Phase(double cosine)
    {
        var g = Anisotropy;
        var root = Math.Sqrt(1 + (g * g) - (2 * g * cosine));
        return (1 - (g * g)) / (4 * Math.PI * root * root * root);
    }
}
