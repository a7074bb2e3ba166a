using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Scenes.Lights;

/// <summary>The radiance of a <see cref="Sky"/> in all directions, linear light: red, green, blue.</summary>
/// <param name="Zenith">Straight above.</param>
/// <param name="Horizon">At the height of the eye.</param>
/// <param name="Ground">Straight below.</param>
public readonly record struct SkyRadiance(Vector Zenith, Vector Horizon, Vector Ground)
{
    /// <summary>Computes the radiance of a direction.</summary>
    /// <param name="height">The y coordinate of the unit direction.</param>
    public Vector At(double height) => height >= 0
        ? Horizon + (height * (Zenith - Horizon))
        : Horizon + (Math.Sqrt(-height) * (Ground - Horizon));
}
