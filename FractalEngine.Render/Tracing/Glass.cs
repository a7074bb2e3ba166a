using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Render.Lights;

namespace FractalEngine.Render.Tracing;

/// <summary>The material within a solid that refracts light.</summary>
/// <param name="RefractiveIndex">More than 1.</param>
/// <param name="Roughness">α of the facets of its surface (GGX); 0 for a smooth one.</param>
/// <param name="Absorption">The share of light that is lost in a unit of way, where that is small, for each component.</param>
internal sealed record Glass(double RefractiveIndex, double Roughness, Vector Absorption)
{
    // What hardly lets any light through is as dark as this: as good as black, and still a number.
    private const double MinTransmission = 1e-9;

    /// <summary>Translates a material; null unless it is glass.</summary>
    public static Glass? Of(Material material)
    {
        if (!material.IsGlass)
        {
            return null;
        }

        // Programs write black where nothing is said.
        var (red, green, blue) = material.Transmission == Colour.Black ? Colour.White : material.Transmission;
        var roughness = Gloss.Of(material)!.Roughness;
        return new(
            material.RefractiveIndex, roughness > FacetAlbedo.MinRoughness ? roughness : 0,
            new(AbsorptionOf(red), AbsorptionOf(green), AbsorptionOf(blue)));
    }

    /// <summary>The light that is left after a way within, for each component.</summary>
    /// <param name="distance">The way, scene units.</param>
    public Vector TransmissionOver(double distance) => new(
        Math.Exp(-distance * Absorption.X), Math.Exp(-distance * Absorption.Y), Math.Exp(-distance * Absorption.Z));

    /// <summary>Chooses whether light is mirrored or refracted, by Fresnel's law, and where it comes from. No light is lost.</summary>
    /// <remarks>
    /// Facets after Walter and others, EGSR 2007, sampled by those that the eye sees. Light between facets, which that leaves out, is
    /// counted with the rest.
    /// </remarks>
    /// <param name="surface">The surface, on the side of the eye.</param>
    /// <param name="toEye">Unit direction.</param>
    /// <param name="samples">Choose the facet, and one of both ways.</param>
    /// <param name="isRefracted">Whether the direction leads through the surface.</param>
    /// <returns>Unit direction of the light's origin.</returns>
    public Vector Sample(in TracedSurface surface, Vector toEye, ref SampleSequence samples, out bool isRefracted)
    {
        var facet = surface.Normal;
        if (Roughness > 0)
        {
            var axes = FacetAlbedo.AxesAround(surface.Normal);
            facet = axes * FacetAlbedo.VisibleFacet(axes.Transpose() * toEye, Roughness, samples.Next());
        }

        var index = surface.IsInside ? 1 / RefractiveIndex : RefractiveIndex;
        var cosine = Vector.Dot(toEye, facet);
        var squaredCosineBeyond = 1 - ((1 - (cosine * cosine)) / (index * index));
        var cosineBeyond = Math.Sqrt(Math.Max(0, squaredCosineBeyond));
        isRefracted = squaredCosineBeyond > 0 && samples.NextNumber() >= Reflectance(cosine, cosineBeyond, index);
        var direction = isRefracted
            ? (((cosine / index) - cosineBeyond) * facet) - (toEye / index)
            : (2 * cosine * facet) - toEye;
        // Facets, and normals for shading, lean away from the face: what would lead to its wrong side is mirrored by it.
        var height = Vector.Dot(surface.FaceNormal, direction);
        return height > 0 == isRefracted ? direction - (2 * height * surface.FaceNormal) : direction;
    }

    /// <summary>The part of light that a smooth surface mirrors, by Fresnel's law.</summary>
    /// <param name="cosine">Of the angle of the light.</param>
    /// <param name="cosineBeyond">Of its angle when it is refracted.</param>
    /// <param name="index">The index beyond the surface, by that before it.</param>
    internal static double Reflectance(double cosine, double cosineBeyond, double index)
    {
        var parallel = ((index * cosine) - cosineBeyond) / ((index * cosine) + cosineBeyond);
        var across = (cosine - (index * cosineBeyond)) / (cosine + (index * cosineBeyond));
        return 0.5 * ((parallel * parallel) + (across * across));
    }

    private static double AbsorptionOf(double transmission) =>
        transmission < 1 ? -Math.Log(Math.Max(transmission, MinTransmission)) : 0;
}
