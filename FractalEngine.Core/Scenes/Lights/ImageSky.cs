using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes.Cameras;

namespace FractalEngine.Core.Scenes.Lights;

/// <summary>A sky that an image of all directions shows, in a file of Radiance (<c>.hdr</c>).</summary>
/// <param name="File">The image's file as the scene names it, relative to the scene's file.</param>
/// <param name="Turn">
/// Angle in degrees by which the image is turned about +y, in the sense of an object's rotation (0, angle, 0).
/// </param>
/// <param name="Scale">Factor of the image's light, positive.</param>
/// <remarks>
/// The image is equirectangular: its rows lead from straight above to straight below, and its middle is what a camera without rotation
/// looks at, +z in a left-handed scene. Two skies are equal when all that a scene file says of them is equal.
/// </remarks>
public sealed record ImageSky(string File, double Turn = 0, double Scale = 1) : Sky
{
    /// <summary>What the file holds; null where it is not loaded. Such a sky is black.</summary>
    public SkyImage? Image { get; init; }

    /// <inheritdoc/>
    public override Vector HorizonRadiance => Scale * (Image?.Horizon ?? Vector.Zero);

    /// <inheritdoc/>
    public override IReadOnlyList<object> Declaration =>
    [
        "sky", $"\"{File}\"", .. Turn == 0 && double.IsPositive(Turn) ? (object[])[] : ["turn", Turn],
        .. Scale == 1 ? (object[])[] : ["scale", Scale],
    ];

    /// <inheritdoc/>
    public override SkyRadiance ToRadiance(Handedness handedness) => Image is { } image
        ? new ImageRadiance(image, Turn, Scale, handedness)
        : new ColourRadiance(Vector.Zero, Vector.Zero, Vector.Zero);

    /// <inheritdoc/>
    public bool Equals(ImageSky? other) => other is not null && (File, Turn, Scale).Equals((other.File, other.Turn, other.Scale));

    /// <inheritdoc/>
    public override int GetHashCode() => HashCode.Combine(File, Turn, Scale);
}
