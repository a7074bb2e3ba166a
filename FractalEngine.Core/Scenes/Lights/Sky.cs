using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Scenes.Lights;

/// <summary>The sky around a scene: what is seen behind everything, and light from all directions.</summary>
/// <param name="Zenith">Colour straight above (+y), sRGB.</param>
/// <param name="Horizon">Colour at the height of the eye, sRGB.</param>
/// <param name="Ground">Colour straight below, sRGB; null for a dark grey-brown of a third of the horizon's light.</param>
/// <remarks>
/// A colour of the sky is its radiance: a white surface under an even sky, without shadows, has the sky's colour. In between, the linear
/// radiance is h + (z − h)·y above the horizon and h + (g − h)·√−y below it, where y is the height of the unit direction.
/// </remarks>
public sealed record Sky(Colour Zenith, Colour Horizon, Colour? Ground = null)
{
    private static readonly Vector DefaultGroundAlbedo = new(0.34, 0.31, 0.28);

    /// <summary>Radiance straight below, linear light: red, green, blue.</summary>
    public Vector GroundRadiance => Ground is { } ground ? ground.ToLinearVector() : DefaultGroundAlbedo.Stretch(Horizon.ToLinearVector());

    /// <summary>Radiance straight above, linear light.</summary>
    public Vector ZenithRadiance => Zenith.ToLinearVector();

    /// <summary>Radiance at the horizon, linear light.</summary>
    public Vector HorizonRadiance => Horizon.ToLinearVector();

    /// <summary>The sky as a function of directions, for many of them.</summary>
    public SkyRadiance ToRadiance() => new(ZenithRadiance, HorizonRadiance, GroundRadiance);

    /// <summary>
    /// Computes the light on surfaces without shadows as a + b·c + d·c², where c is the y coordinate of the surface's unit normal: the
    /// irradiance divided by π, from the sky's first three zonal harmonics.
    /// </summary>
    /// <returns>The coefficients a, b and d, linear light.</returns>
    public (Vector Constant, Vector Linear, Vector Quadratic) Irradiance()
    {
        // Integrals of Pl(y)·f(y) over one half of the sphere, f being 1, y above and √−y below, for l = 0, 1, 2:
        // above, of 1: (1, 1/2, 0); of y: (1/2, 1/3, 1/8); below, of 1: (1, −1/2, 0); of √−y: (2/3, −2/5, 2/21).
        var horizon = HorizonRadiance;
        var above = ZenithRadiance - horizon;
        var below = GroundRadiance - horizon;
        var l0 = (2 * horizon) + (1.0 / 2 * above) + (2.0 / 3 * below);
        var l1 = (1.0 / 3 * above) - (2.0 / 5 * below);
        var l2 = (1.0 / 8 * above) + (2.0 / 21 * below);
        // The cosine lobe weighs them by 1, 2/3, 1/4 (Ramamoorthi and Hanrahan, SIGGRAPH 2001); (2l + 1)/2 is the norm of Pl.
        var (c0, c1, c2) = (0.5 * l0, 3.0 / 2 * (2.0 / 3) * l1, 5.0 / 2 * (1.0 / 4) * l2);
        return (c0 - (0.5 * c2), c1, 1.5 * c2);
    }
}
