using FractalEngine.Core.Maths;
using FractalEngine.Render.Drawables;
using FractalEngine.Render.Lights;

namespace FractalEngine.Render.Tracing;

/// <summary>A material as the path tracer needs it: colours in linear light, textures decoded.</summary>
internal sealed class TracedMaterial
{
    // As bright as the brightest light of a scene.
    private const double MaxEmission = 1e9;

    private TracedMaterial()
    {
    }

    /// <summary>The surface without a material: the object's own colour, matt.</summary>
    public static TracedMaterial Default { get; } = new();

    /// <summary>The colour, which that of object, vertices and texture multiply; null for the object's own.</summary>
    public Vector? BaseColour { get; private init; }

    /// <summary>What mirrors; null for a matt surface.</summary>
    public Gloss? Gloss { get; private init; }

    /// <summary>What solids of the material refract light by; null for none.</summary>
    public Glass? Glass { get; private init; }

    /// <summary>Radiance of the surface itself.</summary>
    public Vector Emission { get; private init; }

    /// <summary>The opacity, from 0 to 1.</summary>
    public double Opacity { get; private init; } = 1;

    /// <summary>True where a texture of half the opacity cuts a hole.</summary>
    public bool IsCutOut { get; private init; }

    /// <summary>Colour and opacity; null for none.</summary>
    public TracedTexture? Texture { get; private init; }

    /// <summary>Normals in tangent space, or heights; null for none.</summary>
    public TracedTexture? Detail { get; private init; }

    /// <summary>Whether these are normals.</summary>
    public bool HasNormals { get; private init; }

    /// <summary>True where light may pass.</summary>
    public bool IsSeeThrough { get; private init; }

    /// <summary>True where texture coordinates are needed.</summary>
    public bool IsTextured => Texture is not null || Detail is not null;

    /// <summary>Prepares a material for tracing.</summary>
    /// <param name="drawable">With its decoded textures.</param>
    public static TracedMaterial Create(DrawableMaterial drawable)
    {
        var material = drawable.Material;
        return new()
        {
            BaseColour = Limit(material.Diffuse.ToLinearVector(), 1),
            Gloss = Gloss.Of(material),
            Glass = Glass.Of(material),
            Emission = Limit(new Vector(material.Emission.Red, material.Emission.Green, material.Emission.Blue), MaxEmission),
            Opacity = Limit(material.Opacity, 1),
            IsCutOut = drawable.IsCutOut,
            IsSeeThrough = drawable.IsTransparent || drawable.IsCutOut,
            Texture = drawable.Texture is { } texture && material.Texture is { } mapping ? new(texture.Image, mapping) : null,
            Detail = drawable.Detail is { } detail && material.DetailTexture is { } place ? new(detail.Image, place) : null,
            HasNormals = material.NormalTexture is not null,
        };
    }

    private static Vector Limit(Vector colour, double max) => new(Limit(colour.X, max), Limit(colour.Y, max), Limit(colour.Z, max));

    // 0 for what is no number, too.
    private static double Limit(double number, double max) => number > 0 ? Math.Min(number, max) : 0;
}
