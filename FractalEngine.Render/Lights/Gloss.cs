using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Render.Lights;

/// <summary>What makes a surface glossy: a coat that mirrors, above what is scattered, and metal, which mirrors in its colour.</summary>
/// <remarks>
/// A mixture of a coated surface and of a metal, as glTF 2.0 has it. Facets mirror once (GGX) or several times (C. Kulla and A. Conty,
/// SIGGRAPH 2017); what the coat lets through is scattered, and leaves through the coat (C. Kelemen and L. Szirmay-Kalos, Eurographics
/// 2001). White surfaces of any mixture and roughness return all light, to the error of <see cref="FacetAlbedo"/>.
/// </remarks>
internal sealed class Gloss
{
    // Of a surface that mirrors all nothing is left to be scattered: nothing over nothing.
    private const double MinRest = 1e-6;

    // What is not metal reflects about this part of light that falls straight onto it.
    private const double DielectricReflectance = 0.04;

    private readonly FacetAlbedo _mean;

    /// <summary>Prepares what does not depend on directions.</summary>
    /// <param name="coat">The part of light that the coat mirrors where it falls straight onto the surface.</param>
    /// <param name="metalness">The share of metal, from 0 to 1.</param>
    /// <param name="roughness">α of the distribution of GGX, from <see cref="FacetAlbedo.MinRoughness"/> to 1.</param>
    public Gloss(Vector coat, double metalness, double roughness)
    {
        Coat = coat;
        Metalness = metalness;
        Roughness = roughness;
        _mean = FacetAlbedo.MeanOf(roughness);
        CoatOfSeveral = OfSeveralFacets(coat);
        RestOfCoat = Vector.Max(Through(_mean), MinRest * Vector.One);
    }

    /// <summary>The part of light that the coat mirrors where it falls straight onto the surface.</summary>
    public Vector Coat { get; }

    /// <summary>The share of metal, from 0 to 1.</summary>
    public double Metalness { get; }

    /// <summary>α of the distribution of GGX.</summary>
    public double Roughness { get; }

    /// <summary>The mean part of white light that white facets don't send out after one reflection.</summary>
    public double RestOfFacets => 1 - _mean.White;

    /// <summary>What the coat reflects of light that meets several facets.</summary>
    public Vector CoatOfSeveral { get; }

    /// <summary>The mean part of light that comes through the coat.</summary>
    public Vector RestOfCoat { get; }

    /// <summary>Translates a material; null for a matt one.</summary>
    /// <remarks>
    /// Numbers beyond their range are limited: a surface that sent back more light than it gets, or less than none, would have paths of
    /// light without end.
    /// </remarks>
    /// <param name="material">As a file declares it.</param>
    public static Gloss? Of(Material material)
    {
        if (!material.IsGlossy)
        {
            return null;
        }

        var (red, green, blue) = material.Specular;
        var isStated = material.IsPhysical || material.IsGlass;
        var roughness = Math.Pow(Limit(material.Roughness ?? (material.IsGlass ? 0 : 1)), 2);
        return new(
            material.IsGlass ? Math.Pow((material.RefractiveIndex - 1) / (material.RefractiveIndex + 1), 2) * Vector.One
                : isStated ? DielectricReflectance * Vector.One : new(Limit(red), Limit(green), Limit(blue)),
            Limit(material.Metalness ?? 0),
            // An exponent and a roughness with highlights of the same width (Walter and others, EGSR 2007).
            Math.Max(FacetAlbedo.MinRoughness, isStated ? roughness : Math.Sqrt(2 / (Math.Max(0, material.SpecularExponent) + 2))));
    }

    /// <summary>The part of light that a surface of a colour mirrors where it falls straight onto it.</summary>
    public Vector Specular(Vector colour) => ((1 - Metalness) * Coat) + (Metalness * colour);

    /// <summary>Computes what leaves evenly scattered: below the coat, and by several facets. Both directions may be exchanged.</summary>
    /// <param name="colour">Linear light, at most 1.</param>
    /// <param name="eye">Facets seen from the eye.</param>
    /// <param name="light">Facets seen from the light.</param>
    /// <returns>π times the reflectance.</returns>
    public Vector Scattered(Vector colour, FacetAlbedo eye, FacetAlbedo light)
    {
        var several = (1 - eye.White) * (1 - light.White) / RestOfFacets * SpecularOfSeveral(colour);
        var (red, green, blue) = (1 - Metalness) * colour.Stretch(Through(eye)).Stretch(Through(light));
        return several + new Vector(red / RestOfCoat.X, green / RestOfCoat.Y, blue / RestOfCoat.Z);
    }

    /// <summary>The part of light that leaves in all directions of what comes from one: mirrored once, and scattered.</summary>
    /// <param name="colour">Linear light, at most 1.</param>
    /// <param name="eye">Facets seen from that direction.</param>
    /// <param name="scattered">The second part.</param>
    public Vector Albedo(Vector colour, FacetAlbedo eye, out Vector scattered)
    {
        scattered = ((1 - eye.White) * SpecularOfSeveral(colour)) + ((1 - Metalness) * colour.Stretch(Through(eye)));
        return (eye.Normal * Specular(colour)) + (eye.Grazing * Vector.One);
    }

    private Vector SpecularOfSeveral(Vector colour) => Metalness > 0
        ? ((1 - Metalness) * CoatOfSeveral) + (Metalness * OfSeveralFacets(colour))
        : CoatOfSeveral;

    /// <summary>The part of light from one direction that comes through the coat.</summary>
    private Vector Through(FacetAlbedo facets) =>
        Vector.One - ((facets.Normal * Coat) + (facets.Grazing * Vector.One) + ((1 - facets.White) * CoatOfSeveral));

    private Vector OfSeveralFacets(Vector specular)
    {
        var white = _mean.White;
        return new(Component(specular.X), Component(specular.Y), Component(specular.Z));

        double Component(double f)
        {
            // The mean of Schlick's term over all angles.
            var facet = f + ((1 - f) / 21);
            return facet * facet * white / (1 - (facet * (1 - white)));
        }
    }

    // 0 for what is no number, too.
    private static double Limit(double number) => number > 0 ? Math.Min(number, 1) : 0;
}
