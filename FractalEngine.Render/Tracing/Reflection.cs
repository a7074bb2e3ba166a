using FractalEngine.Core.Maths;
using FractalEngine.Render.Lights;

namespace FractalEngine.Render.Tracing;

/// <summary>How a surface reflects light: evenly scattered, and mirrored by small facets (GGX).</summary>
/// <remarks>
/// The facets after Walter and others, "Microfacet Models for Refraction through Rough Surfaces", EGSR 2007, with Schlick's Fresnel term;
/// the rest is that of <see cref="Gloss"/>. A normal for shading leans away from the face, and some directions would lead
/// below it: they are mirrored by the face, so that no light is lost.
/// </remarks>
internal static class Reflection
{
    /// <summary>Computes how much of the light from a direction goes towards the eye: π times the reflectance, times the cosine.</summary>
    /// <param name="surface">The surface.</param>
    /// <param name="toEye">Unit direction.</param>
    /// <param name="toLight">Unit direction.</param>
    public static Vector Evaluate(in TracedSurface surface, Vector toEye, Vector toLight)
    {
        var height = Vector.Dot(surface.FaceNormal, toLight);
        return height > 0
            ? EvaluateLobe(in surface, toEye, toLight) + EvaluateLobe(in surface, toEye, toLight - (2 * height * surface.FaceNormal))
            : Vector.Zero;
    }

    /// <summary>Computes how likely <see cref="TrySample"/> chooses a direction.</summary>
    /// <param name="surface">The surface.</param>
    /// <param name="toEye">Unit direction.</param>
    /// <param name="toLight">Unit direction.</param>
    /// <returns>The probability for each unit of solid angle.</returns>
    public static double Density(in TracedSurface surface, Vector toEye, Vector toLight)
    {
        var height = Vector.Dot(surface.FaceNormal, toLight);
        if (!(height > 0))
        {
            return 0;
        }

        var mirrored = MirroredPart(in surface, toEye);
        return DensityOfLobe(in surface, toEye, toLight, mirrored)
            + DensityOfLobe(in surface, toEye, toLight - (2 * height * surface.FaceNormal), mirrored);
    }

    /// <summary>Chooses the direction from which light is followed further.</summary>
    /// <param name="surface">The surface.</param>
    /// <param name="toEye">Unit direction.</param>
    /// <param name="samples">The points of the sample.</param>
    /// <param name="direction">Unit direction towards the light.</param>
    /// <param name="weight">Factor of the radiance from there, so that the mean over all choices is right.</param>
    /// <param name="spread">How wide the choice is, as an angle in radians.</param>
    /// <returns>False where the light is absorbed.</returns>
    public static bool TrySample(
        in TracedSurface surface, Vector toEye, ref SampleSequence samples, out Vector direction, out Vector weight, out double spread)
    {
        var mirrored = MirroredPart(in surface, toEye);
        var isMirrored = mirrored > 0 && samples.NextNumber() < mirrored;
        var point = samples.Next();
        var axes = FacetAlbedo.AxesAround(surface.Normal);
        if (isMirrored)
        {
            var half = axes * FacetAlbedo.VisibleFacet(axes.Transpose() * toEye, surface.Gloss!.Roughness, point);
            direction = (2 * Vector.Dot(toEye, half) * half) - toEye;
        }
        else
        {
            var radius = Math.Sqrt(point.U);
            var (sine, cosineAround) = Math.SinCos(2 * Math.PI * point.V);
            direction = axes * new Vector(radius * cosineAround, radius * sine, Math.Sqrt(Math.Max(0, 1 - point.U)));
        }

        spread = isMirrored ? surface.Gloss!.Roughness : 1;
        // Scattered light alone has the same weight everywhere.
        weight = surface.Colour;
        var density = 1.0;
        if (surface.Gloss is not null)
        {
            density = Math.PI * DensityOfLobe(in surface, toEye, direction, mirrored);
            weight = EvaluateLobe(in surface, toEye, direction) / Math.Max(density, double.Epsilon);
        }

        var height = Vector.Dot(surface.FaceNormal, direction);
        direction -= height < 0 ? 2 * height * surface.FaceNormal : Vector.Zero;
        return weight != Vector.Zero && height != 0 && density > 0;
    }

    /// <summary>The same as <see cref="Evaluate"/>, of directions above the plane of the normal for shading alone.</summary>
    private static Vector EvaluateLobe(in TracedSurface surface, Vector toEye, Vector toLight)
    {
        var cosine = Vector.Dot(surface.Normal, toLight);
        if (!(cosine > 0))
        {
            return Vector.Zero;
        }

        if (surface.Gloss is not { } gloss)
        {
            return cosine * surface.Colour;
        }

        var half = (toEye + toLight).UnitVector();
        var cosineEye = CosineEye(in surface, toEye);
        var alphaSquared = gloss.Roughness * gloss.Roughness;
        var shadowing = FacetAlbedo.Shadowing(cosineEye, alphaSquared) * FacetAlbedo.Shadowing(cosine, alphaSquared);
        var mirrored = Distribution(Vector.Dot(surface.Normal, half), alphaSquared) * shadowing / (4 * cosineEye);
        var eye = FacetAlbedo.At(cosineEye, gloss.Roughness);
        return (mirrored * Fresnel(gloss.Specular(surface.Colour), Vector.Dot(toLight, half)))
            + (cosine * gloss.Scattered(surface.Colour, eye, FacetAlbedo.At(cosine, gloss.Roughness)));
    }

    /// <summary>How likely the part of light is followed that facets mirror once.</summary>
    private static double MirroredPart(in TracedSurface surface, Vector toEye)
    {
        if (surface.Gloss is not { } gloss)
        {
            return 0;
        }

        var mirrored = Vector.Dot(DisplayTransform.Luminance, gloss.Albedo(
            surface.Colour, FacetAlbedo.At(CosineEye(in surface, toEye), gloss.Roughness), out var scattered));
        var sum = mirrored + Vector.Dot(DisplayTransform.Luminance, scattered);
        return sum > 0 ? mirrored / sum : 0;
    }

    private static double DensityOfLobe(in TracedSurface surface, Vector toEye, Vector toLight, double mirroredPart)
    {
        var cosine = Vector.Dot(surface.Normal, toLight);
        if (!(cosine > 0))
        {
            return 0;
        }

        var scattered = (1 - mirroredPart) * cosine / Math.PI;
        if (surface.Gloss is not { } gloss)
        {
            return scattered;
        }

        var cosineEye = CosineEye(in surface, toEye);
        var alphaSquared = gloss.Roughness * gloss.Roughness;
        var facets = Distribution(Vector.Dot(surface.Normal, (toEye + toLight).UnitVector()), alphaSquared) / Math.PI;
        return scattered + (mirroredPart * facets * FacetAlbedo.Shadowing(cosineEye, alphaSquared) / (4 * cosineEye));
    }

    // A bent normal may nearly turn away from the eye.
    private static double CosineEye(in TracedSurface surface, Vector toEye) => Math.Max(Vector.Dot(surface.Normal, toEye), 1e-6);

    /// <summary>π times the density of facets (GGX).</summary>
    private static double Distribution(double cosineHalf, double alphaSquared)
    {
        var d = (cosineHalf * cosineHalf * (alphaSquared - 1)) + 1;
        return alphaSquared / (d * d);
    }

    private static Vector Fresnel(Vector specular, double cosine)
    {
        var rest = Math.Clamp(1 - cosine, 0, 1);
        var power = rest * rest * (rest * rest) * rest;
        return specular + (power * (Vector.One - specular));
    }

    /// <summary>Chooses a unit direction of a cone, each as likely as another.</summary>
    /// <param name="axes">Orthonormal axes whose third is in the middle, see <see cref="FacetAlbedo.AxesAround"/>.</param>
    /// <param name="cosine">Cosine of the largest angle with the axis.</param>
    /// <param name="point">A point of the unit square.</param>
    public static Vector SampleCone(in Matrix axes, double cosine, (double U, double V) point)
    {
        var z = 1 - (point.U * (1 - cosine));
        var radius = Math.Sqrt(Math.Max(0, 1 - (z * z)));
        var (sine, cosineAround) = Math.SinCos(2 * Math.PI * point.V);
        return axes * new Vector(radius * cosineAround, radius * sine, z);
    }
}
