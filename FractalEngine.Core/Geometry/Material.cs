namespace FractalEngine.Core.Geometry;

/// <summary>How a surface looks: what a material file (<c>.mtl</c>) says of one material.</summary>
/// <param name="Name">As <c>usemtl</c> refers to it.</param>
public sealed record Material(string Name)
{
    // Neither the white of paper nor so dark that shading is lost on it.
    private const double MissingTextureGrey = 0.6;

    /// <summary><c>Kd</c>: the colour under light from one direction, sRGB; a texture multiplies it.</summary>
    public Colour Diffuse { get; init; } = Colour.White;

    /// <summary><c>Ka</c>: how much of the ambient light acts on the surface, a factor for each component of linear light.</summary>
    public Colour Ambient { get; init; } = Colour.White;

    /// <summary><c>Ks</c>: how much of a light the highlight returns, a factor for each component of linear light.</summary>
    public Colour Specular { get; init; } = Colour.Black;

    /// <summary><c>Ns</c>: the larger, the smaller and sharper the highlight.</summary>
    public double SpecularExponent { get; init; } = 1;

    /// <summary><c>d</c>, or 1 − <c>Tr</c>: 1 hides what is behind, 0 is invisible.</summary>
    public double Opacity { get; init; } = 1;

    /// <summary><c>map_Kd</c>; null where there is no picture.</summary>
    public MaterialTexture? Texture { get; init; }

    /// <summary>Whether there is a highlight at all.</summary>
    public bool IsGlossy => Specular != Colour.Black;

    /// <summary>The same material where its picture can't be had: an even grey takes its place.</summary>
    public Material WithoutTexture() => this with
    {
        Texture = null,
        Diffuse = new(MissingTextureGrey * Diffuse.Red, MissingTextureGrey * Diffuse.Green, MissingTextureGrey * Diffuse.Blue),
    };
}
