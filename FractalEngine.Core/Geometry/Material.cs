namespace FractalEngine.Core.Geometry;

/// <summary>The appearance of a surface, as a material file (<c>.mtl</c>) describes it.</summary>
/// <param name="Name">Name that <c>usemtl</c> refers to.</param>
public sealed record Material(string Name)
{
    // Neither white nor so dark that shading is lost on it.
    private const double MissingTextureGrey = 0.6;

    /// <summary><c>Kd</c>: the diffuse colour, sRGB; a texture multiplies it.</summary>
    public Colour Diffuse { get; init; } = Colour.White;

    /// <summary><c>Ka</c>: the factor of ambient light, for each component of linear light.</summary>
    public Colour Ambient { get; init; } = Colour.White;

    /// <summary><c>Ks</c>: the part of light that is mirrored where it falls straight onto the surface, for each component.</summary>
    public Colour Specular { get; init; } = Colour.Black;

    /// <summary><c>Ke</c>: the light that the surface emits, for each component of linear light; it may exceed 1.</summary>
    public Colour Emission { get; init; } = Colour.Black;

    /// <summary><c>Ns</c>: the specular exponent; a larger one makes a smaller, sharper and brighter highlight.</summary>
    public double SpecularExponent { get; init; } = 1;

    /// <summary><c>d</c>, or 1 − <c>Tr</c>: the opacity, from 0 (invisible) to 1 (opaque).</summary>
    public double Opacity { get; init; } = 1;

    /// <summary><c>Ni</c>: the index of refraction, 1 where light is not refracted.</summary>
    public double RefractiveIndex { get; init; } = 1;

    /// <summary><c>Tf</c>: the part of light that is left after one scene unit within, for each component of linear light.</summary>
    public Colour Transmission { get; init; } = Colour.White;

    /// <summary>Whether solids of the material are glass, which refracts light: transparent, with an index above 1.</summary>
    public bool IsGlass => RefractiveIndex > 1 && Opacity < 1;

    /// <summary><c>map_Kd</c>: the diffuse texture; null where there is none.</summary>
    public MaterialTexture? Texture { get; init; }

    /// <summary><c>map_Ke</c>: a texture of emitted light; null where there is none. It is kept, and not shown yet.</summary>
    public MaterialTexture? EmissionTexture { get; init; }

    /// <summary><c>map_Bump</c>: a texture of heights; null where there is none. <c>norm</c> goes before it.</summary>
    public MaterialTexture? BumpTexture { get; init; }

    /// <summary><c>norm</c>: a texture of normals in tangent space; null where there is none.</summary>
    public MaterialTexture? NormalTexture { get; init; }

    /// <summary><c>Pr</c>: the roughness, from 0 (smooth) to 1; null where there is none.</summary>
    public double? Roughness { get; init; }

    /// <summary><c>Pm</c>: the share of metal, from 0 to 1; null where there is none.</summary>
    public double? Metalness { get; init; }

    /// <summary>
    /// <c>map_d</c>: an image of the opacity, its alpha where any pixel is transparent, otherwise its lightness; null where there is none.
    /// </summary>
    public MaterialTexture? OpacityTexture { get; init; }

    /// <summary>Whether drawing the material needs texture coordinates.</summary>
    public bool IsTextured => Texture is not null || OpacityTexture is not null || DetailTexture is not null;

    /// <summary>The texture that bends the normals of the surface: that of normals, or else that of heights; null for none.</summary>
    public MaterialTexture? DetailTexture => NormalTexture ?? BumpTexture;

    /// <summary>Whether the material mirrors part of the light.</summary>
    public bool IsGlossy => Specular != Colour.Black || IsPhysical || IsGlass;

    /// <summary>Whether the material states its roughness or share of metal: then <c>Ks</c> and <c>Ns</c> have no meaning.</summary>
    public bool IsPhysical => Roughness is not null || Metalness is not null;

    /// <summary>Replaces the texture by an even grey, for a texture whose image can't be loaded.</summary>
    public Material WithoutTexture() => this with
    {
        Texture = null,
        Diffuse = new(MissingTextureGrey * Diffuse.Red, MissingTextureGrey * Diffuse.Green, MissingTextureGrey * Diffuse.Blue),
    };

    /// <summary>Returns the material for faces without texture coordinates: its numbers, and no image.</summary>
    public Material WithoutImages() =>
        this with { Texture = null, OpacityTexture = null, EmissionTexture = null, BumpTexture = null, NormalTexture = null };
}
