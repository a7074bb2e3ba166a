using System.Collections.Immutable;

namespace FractalEngine.Core.Geometry;

/// <summary>
/// A texture of a material: an image file, and how texture coordinates map to it.
/// </summary>
/// <remarks>
/// Texture coordinates (u, v) show the point scale · (u, v) + offset of the image. Its lower left corner is (0, 0), its upper right corner
/// (1, 1).
/// </remarks>
/// <param name="Path">Path of the image file: as the material file names it, or in full once it has been resolved.</param>
public sealed record MaterialTexture(string Path)
{
    /// <summary>
    /// The bytes of an image that is part of another file; empty for a file of its own. The path is then a name that no other image has.
    /// </summary>
    public ImmutableArray<byte> Contents { get; init; } = [];

    /// <summary><c>-clamp on</c>: beyond its edges the texture continues with their colours instead of repeating.</summary>
    public bool IsClamped { get; init; }

    /// <summary><c>-s</c>: the scale of the texture coordinates.</summary>
    public (double U, double V) Scale { get; init; } = (1, 1);

    /// <summary><c>-o</c>: the offset of the texture coordinates.</summary>
    public (double U, double V) Offset { get; init; }

    /// <summary><c>-bm</c>: the factor of the heights of a bump map.</summary>
    public double BumpFactor { get; init; } = 1;
}
