using FractalEngine.Core.Geometry;

namespace FractalEngine.Render.Preparation;

/// <summary>A material with its picture.</summary>
/// <param name="Material">What the file says.</param>
/// <param name="Texture">Null where it has none.</param>
public sealed record DrawableMaterial(Material Material, DrawableTexture? Texture)
{
    /// <summary>Whether what lies behind shows through: such surfaces are drawn last, and blended.</summary>
    public bool IsTransparent => Material.Opacity < 1 || Texture is { IsTransparent: true };
}
