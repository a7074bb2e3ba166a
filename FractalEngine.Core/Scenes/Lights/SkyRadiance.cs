using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Scenes.Lights;

/// <summary>The radiance of a <see cref="Sky"/> in all directions of world space, linear light: red, green, blue.</summary>
public abstract record SkyRadiance
{
    /// <summary>Computes the radiance of a direction, or about the mean around it.</summary>
    /// <param name="unitDirection">A unit vector.</param>
    /// <param name="solidAngle">How much is seen of the sky, in steradians; 0 for a point of it.</param>
    public abstract Vector At(Vector unitDirection, double solidAngle = 0);

    /// <summary>Computes the light on surfaces without shadows, from harmonics up to the second degree.</summary>
    public abstract SkyIrradiance Irradiance();
}
