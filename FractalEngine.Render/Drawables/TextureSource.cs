using FractalEngine.Core.Files;

namespace FractalEngine.Render.Drawables;

/// <summary>The image files of a texture as they were before they were decoded. Equal sources give the same texture.</summary>
/// <param name="ColourPath">Full path of the colours; null for white.</param>
/// <param name="Colour">Stamp of the file of the colours.</param>
/// <param name="OpacityPath">Full path of the opacity; null where the colours have it.</param>
/// <param name="Opacity">Stamp of the file of the opacity.</param>
internal sealed record TextureSource(string? ColourPath, FileStamp Colour, string? OpacityPath, FileStamp Opacity)
{
    /// <summary>Reads the present stamps of image files.</summary>
    public static TextureSource Of(string? colourPath, string? opacityPath) => new(
        colourPath, colourPath is null ? FileStamp.Missing : FileStamp.Of(colourPath),
        opacityPath, opacityPath is null ? FileStamp.Missing : FileStamp.Of(opacityPath));
}
