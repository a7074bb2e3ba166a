using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes.Cameras;

namespace FractalEngine.Core.Scenes.Lights;

/// <summary>A sky of two or three colours, the same on all sides.</summary>
/// <param name="Zenith">Colour straight above (+y), sRGB.</param>
/// <param name="Horizon">Colour at the height of the eye, sRGB.</param>
/// <param name="Ground">Colour straight below, sRGB; null for a dark grey-brown of a third of the horizon's light.</param>
/// <remarks>
/// A colour of the sky is its radiance: a white surface under an even sky, without shadows, has the sky's colour. In between, the linear
/// radiance is h + (z − h)·y above the horizon and h + (g − h)·√−y below it, where y is the height of the unit direction.
/// </remarks>
public sealed record ColourSky(Colour Zenith, Colour Horizon, Colour? Ground = null) : Sky
{
    private static readonly Vector DefaultGroundAlbedo = new(0.34, 0.31, 0.28);

    /// <summary>Radiance straight below, linear light: red, green, blue.</summary>
    public Vector GroundRadiance => Ground is { } ground ? ground.ToLinearVector() : DefaultGroundAlbedo.Stretch(Horizon.ToLinearVector());

    /// <summary>Radiance straight above, linear light.</summary>
    public Vector ZenithRadiance => Zenith.ToLinearVector();

    /// <inheritdoc/>
    public override Vector HorizonRadiance => Horizon.ToLinearVector();

    /// <inheritdoc/>
    public override IReadOnlyList<object> Declaration => Ground is { } ground ? ["sky", Zenith, Horizon, ground] : ["sky", Zenith, Horizon];

    /// <inheritdoc/>
    public override SkyRadiance ToRadiance(Handedness handedness) => new ColourRadiance(ZenithRadiance, HorizonRadiance, GroundRadiance);
}
