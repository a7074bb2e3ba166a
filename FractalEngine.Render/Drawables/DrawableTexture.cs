using FractalEngine.Core.Images;

namespace FractalEngine.Render.Drawables;

/// <summary>A texture, decoded once however many materials use it.</summary>
/// <param name="Name">Name of the file, for messages.</param>
/// <param name="Image">Decoded pixels, sRGB.</param>
/// <param name="IsTransparent">Whether any pixel is not fully opaque.</param>
public sealed record DrawableTexture(string Name, PixelImage Image, bool IsTransparent)
{
    /// <summary>Whether many pixels are neither opaque nor invisible, so that a cut at half the opacity would look wrong.</summary>
    public bool HasSoftOpacity { get; init; }

    /// <summary>Whether the pixels are normals or heights, no colours.</summary>
    public bool IsDetail { get; init; }

    /// <summary>The files that the texture was decoded from; null for one that is never decoded again.</summary>
    internal TextureSource? Source { get; init; }
}
