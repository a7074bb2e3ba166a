using FractalEngine.Core.Maths;

namespace FractalEngine.Render.Lights;

/// <summary>What a surface does with light: scattered evenly below a coat that mirrors, and mirrored by metal.</summary>
/// <remarks>
/// A mixture of a coated surface and of a metal, as glTF 2.0 has it. Facets mirror once (GGX) or several times (C. Kulla and A. Conty,
/// SIGGRAPH 2017); what the coat lets through is scattered, and leaves through the coat (C. Kelemen and L. Szirmay-Kalos, Eurographics
/// 2001). White surfaces of any mixture and roughness return all light, to the error of <see cref="FacetAlbedo"/>.
/// </remarks>
internal readonly record struct SurfaceReflectance
{
    // Of a surface that mirrors all nothing is left to be scattered: nothing over nothing.
    private const double MinRest = 1e-6;

    /// <summary>Divides light between what is scattered and what is mirrored.</summary>
    /// <param name="colour">The point's colour in linear light, with texture and all else that multiplies it; at most 1.</param>
    /// <param name="coat">The part of light that the coat mirrors where it falls straight onto the surface; zero for none at all.</param>
    /// <param name="metalness">The share of metal, which mirrors in its colour, from 0 to 1.</param>
    /// <param name="roughness">α of the distribution of GGX.</param>
    public SurfaceReflectance(Vector colour, Vector coat, double metalness, double roughness)
    {
        Diffuse = (1 - metalness) * colour;
        Coat = coat;
        Specular = ((1 - metalness) * coat) + (metalness * colour);
        Roughness = roughness;
        IsGlossy = metalness > 0 || coat != Vector.Zero;
        if (IsGlossy)
        {
            var mean = FacetAlbedo.MeanOf(roughness);
            RestOfFacets = 1 - mean.White;
            CoatOfSeveral = OfSeveralFacets(coat, mean);
            SpecularOfSeveral = ((1 - metalness) * CoatOfSeveral) + (metalness * OfSeveralFacets(colour, mean));
            RestOfCoat = Vector.Max(Through(mean), MinRest * Vector.One);
        }
    }

    /// <summary>The part of light that is scattered, of what the coat lets through.</summary>
    public Vector Diffuse { get; }

    /// <summary>The part of light that the coat mirrors where it falls straight onto the surface.</summary>
    public Vector Coat { get; }

    /// <summary>The same of coat and metal together.</summary>
    public Vector Specular { get; }

    /// <summary>α of the distribution of GGX.</summary>
    public double Roughness { get; }

    /// <summary>Whether part of the light is mirrored.</summary>
    public bool IsGlossy { get; }

    /// <summary>The mean part of light that white facets don't send out after one reflection.</summary>
    public double RestOfFacets { get; }

    /// <summary>What the coat reflects of light that meets several facets.</summary>
    public Vector CoatOfSeveral { get; }

    /// <summary>The same of coat and metal together.</summary>
    public Vector SpecularOfSeveral { get; }

    /// <summary>The mean part of light that comes through the coat.</summary>
    public Vector RestOfCoat { get; }

    /// <summary>Computes what leaves evenly scattered: below the coat, and by several facets. It is symmetrical in both directions.</summary>
    /// <param name="eye">Facets seen from the eye.</param>
    /// <param name="light">Facets seen from the light.</param>
    /// <returns>π times the reflectance.</returns>
    public Vector Scattered(FacetAlbedo eye, FacetAlbedo light)
    {
        var several = (1 - eye.White) * (1 - light.White) / RestOfFacets * SpecularOfSeveral;
        var (red, green, blue) = Diffuse.Stretch(Through(eye)).Stretch(Through(light));
        return several + new Vector(red / RestOfCoat.X, green / RestOfCoat.Y, blue / RestOfCoat.Z);
    }

    /// <summary>The part of light that leaves in all directions of what comes from one: mirrored once, and scattered.</summary>
    /// <param name="eye">Facets seen from that direction.</param>
    /// <param name="scattered">The second part.</param>
    public Vector Albedo(FacetAlbedo eye, out Vector scattered)
    {
        scattered = IsGlossy ? ((1 - eye.White) * SpecularOfSeveral) + Diffuse.Stretch(Through(eye)) : Diffuse;
        return IsGlossy ? (eye.Normal * Specular) + (eye.Grazing * Vector.One) : Vector.Zero;
    }

    /// <summary>The part of light from one direction that comes through the coat.</summary>
    private Vector Through(FacetAlbedo facets) =>
        Vector.One - ((facets.Normal * Coat) + (facets.Grazing * Vector.One) + ((1 - facets.White) * CoatOfSeveral));

    private static Vector OfSeveralFacets(Vector specular, FacetAlbedo mean)
    {
        return new(Component(specular.X), Component(specular.Y), Component(specular.Z));

        double Component(double f)
        {
            // The mean of Schlick's term over all angles.
            var facet = f + ((1 - f) / 21);
            return facet * facet * mean.White / (1 - (facet * (1 - mean.White)));
        }
    }
}
