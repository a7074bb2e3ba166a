using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Scenes.Lights;

/// <summary>The radiance of a <see cref="ColourSky"/> in all directions, linear light: red, green, blue.</summary>
/// <param name="Zenith">Straight above.</param>
/// <param name="Horizon">At the height of the eye.</param>
/// <param name="Ground">Straight below.</param>
public sealed record ColourRadiance(Vector Zenith, Vector Horizon, Vector Ground) : SkyRadiance
{
    /// <inheritdoc/>
    public override Vector At(Vector unitDirection, double solidAngle = 0) => unitDirection.Y >= 0
        ? Horizon + (unitDirection.Y * (Zenith - Horizon))
        : Horizon + (Math.Sqrt(-unitDirection.Y) * (Ground - Horizon));

    /// <inheritdoc/>
    public override SkyIrradiance Irradiance()
    {
        // Integrals of Pl(y)·f(y) over one half of the sphere, f being 1, y above and √−y below, for l = 0, 1, 2:
        // above, of 1: (1, 1/2, 0); of y: (1/2, 1/3, 1/8); below, of 1: (1, −1/2, 0); of √−y: (2/3, −2/5, 2/21).
        var above = Zenith - Horizon;
        var below = Ground - Horizon;
        var l0 = (2 * Horizon) + (1.0 / 2 * above) + (2.0 / 3 * below);
        var l1 = (1.0 / 3 * above) - (2.0 / 5 * below);
        var l2 = (1.0 / 8 * above) + (2.0 / 21 * below);
        // The cosine lobe weighs them by 1, 2/3, 1/4 (Ramamoorthi and Hanrahan, SIGGRAPH 2001); (2l + 1)/2 is the norm of Pl.
        var (c0, c1, c2) = (0.5 * l0, 3.0 / 2 * (2.0 / 3) * l1, 5.0 / 2 * (1.0 / 4) * l2);
        return new(c0 - (0.5 * c2), c1, 1.5 * c2, []);
    }
}
