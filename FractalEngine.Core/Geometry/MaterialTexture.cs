namespace FractalEngine.Core.Geometry;

/// <summary>
/// A picture on a surface. At texture coordinates (u, v) lies its place scale · (u, v) + offset; (0, 0) is its lower left corner, (1, 1)
/// the upper right one.
/// </summary>
/// <param name="Path">The picture's file: as the material file names it, or in full once it has been looked for.</param>
public sealed record MaterialTexture(string Path)
{
    /// <summary><c>-clamp on</c>: beyond its edges the picture goes on with their colours, instead of again from the other side.</summary>
    public bool IsClamped { get; init; }

    /// <summary><c>-s</c>.</summary>
    public (double U, double V) Scale { get; init; } = (1, 1);

    /// <summary><c>-o</c>.</summary>
    public (double U, double V) Offset { get; init; }
}
