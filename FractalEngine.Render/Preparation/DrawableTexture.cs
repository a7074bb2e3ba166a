using FractalEngine.Core.Images;

namespace FractalEngine.Render.Preparation;

/// <summary>A picture for surfaces, decoded once however many materials show it.</summary>
/// <param name="Name">The file's name, for labels.</param>
/// <param name="Image">sRGB.</param>
/// <param name="IsTransparent">Whether any of its pixels lets something through.</param>
public sealed record DrawableTexture(string Name, PixelImage Image, bool IsTransparent);
