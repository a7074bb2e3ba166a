using FractalEngine.Core.Geometry;

namespace FractalEngine.Render.Drawables;

/// <summary>A material with its decoded texture.</summary>
/// <param name="Material">Material as the file declares it.</param>
/// <param name="Texture">Decoded texture; null where the material has none.</param>
public sealed record DrawableMaterial(Material Material, DrawableTexture? Texture)
{
    /// <summary>Normals, or heights where the material has no normals; null for none.</summary>
    public DrawableTexture? Detail { get; init; }

    /// <summary>True where the surface behind shows through. Such surfaces are drawn last, and blended.</summary>
    public bool IsTransparent => !IsCutOut && (Material.Opacity < 1 || Texture is { IsTransparent: true });

    /// <summary>
    /// True where the texture cuts holes, as in foliage: pixels of less than half the opacity are not drawn, all others are opaque. That
    /// needs no order of drawing.
    /// </summary>
    public bool IsCutOut =>
        Material is { OpacityTexture: not null, Opacity: 1 } && Texture is { IsTransparent: true, HasSoftOpacity: false };
}
