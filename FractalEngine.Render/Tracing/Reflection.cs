using FractalEngine.Core.Maths;

namespace FractalEngine.Render.Tracing;

/// <summary>How a surface reflects light: evenly scattered, and mirrored by small facets (GGX).</summary>
/// <remarks>
/// The facets after Walter and others, "Microfacet Models for Refraction through Rough Surfaces", EGSR 2007, with Schlick's Fresnel term;
/// sampled by those that are visible, after E. Heitz, JCGT 2018.
/// </remarks>
internal static class Reflection
{
    /// <summary>Computes how much of the light from a direction goes towards the eye: π times the reflectance, times the cosine.</summary>
    /// <param name="surface">The surface.</param>
    /// <param name="toEye">Unit direction.</param>
    /// <param name="toLight">Unit direction.</param>
    public static Vector Evaluate(in TracedSurface surface, Vector toEye, Vector toLight)
    {
        var cosine = Vector.Dot(surface.Normal, toLight);
        if (!(cosine > 0) || !(Vector.Dot(surface.FaceNormal, toLight) > 0))
        {
            return Vector.Zero;
        }

        var result = cosine * surface.Diffuse;
        if (surface.IsGlossy)
        {
            var half = (toEye + toLight).UnitVector();
            var cosineEye = Math.Max(Vector.Dot(surface.Normal, toEye), 1e-6);
            var alphaSquared = surface.Roughness * surface.Roughness;
            var cosineHalf = Vector.Dot(surface.Normal, half);
            var d = (cosineHalf * cosineHalf * (alphaSquared - 1)) + 1;
            var distribution = alphaSquared / (d * d);
            var shadowing = Shadowing(cosineEye, alphaSquared) * Shadowing(cosine, alphaSquared);
            result += distribution * shadowing / (4 * cosineEye) * Fresnel(surface.Specular, Vector.Dot(toLight, half));
        }

        return result;
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
        var cosineEye = Math.Max(Vector.Dot(surface.Normal, toEye), 1e-6);
        var mirrored = surface.IsGlossy ? Luminance(Fresnel(surface.Specular, cosineEye)) : 0;
        var scattered = Luminance(surface.Diffuse);
        var probability = mirrored + scattered > 0 ? mirrored / (mirrored + scattered) : 0;
        var isMirrored = probability > 0 && samples.NextNumber() < probability;
        var point = samples.Next();
        var axes = AxesAround(surface.Normal);
        if (isMirrored)
        {
            var alphaSquared = surface.Roughness * surface.Roughness;
            var local = axes.Transpose() * toEye;
            var half = axes * VisibleFacet(local, surface.Roughness, point);
            direction = (2 * Vector.Dot(toEye, half) * half) - toEye;
            var cosine = Vector.Dot(surface.Normal, direction);
            weight = Shadowing(Math.Max(cosine, 1e-6), alphaSquared) / probability * Fresnel(surface.Specular, Vector.Dot(direction, half));
            spread = surface.Roughness;
            return cosine > 0 && Vector.Dot(surface.FaceNormal, direction) > 0;
        }

        var radius = Math.Sqrt(point.U);
        var (sine, cosineAround) = Math.SinCos(2 * Math.PI * point.V);
        direction = axes * new Vector(radius * cosineAround, radius * sine, Math.Sqrt(Math.Max(0, 1 - point.U)));
        weight = surface.Diffuse / (1 - probability);
        spread = 1;
        // An interpolated normal leans away from the face, and some directions lead below it. Mirrored there, no light is lost.
        var height = Vector.Dot(surface.FaceNormal, direction);
        direction -= height < 0 ? 2 * height * surface.FaceNormal : Vector.Zero;
        return scattered > 0 && height != 0;
    }

    /// <summary>Computes how likely <see cref="TrySample"/> chooses a direction, per solid angle.</summary>
    /// <param name="surface">The surface.</param>
    /// <param name="toEye">Unit direction.</param>
    /// <param name="toLight">Unit direction.</param>
    public static double Density(in TracedSurface surface, Vector toEye, Vector toLight)
    {
        var height = Vector.Dot(surface.FaceNormal, toLight);
        var cosine = Vector.Dot(surface.Normal, toLight);
        var cosineEye = Math.Max(Vector.Dot(surface.Normal, toEye), 1e-6);
        var mirrored = surface.IsGlossy ? Luminance(Fresnel(surface.Specular, cosineEye)) : 0;
        var scattered = Luminance(surface.Diffuse);
        if (!(height > 0) || !(mirrored + scattered > 0))
        {
            return 0;
        }

        // Directions below the face are mirrored there.
        var below = cosine - (2 * height * Vector.Dot(surface.Normal, surface.FaceNormal));
        var density = scattered * (Math.Max(cosine, 0) + Math.Max(below, 0));
        if (mirrored > 0 && cosine > 0)
        {
            var alphaSquared = surface.Roughness * surface.Roughness;
            var cosineHalf = Vector.Dot(surface.Normal, (toEye + toLight).UnitVector());
            var d = (cosineHalf * cosineHalf * (alphaSquared - 1)) + 1;
            density += mirrored * alphaSquared * Shadowing(cosineEye, alphaSquared) / (4 * cosineEye * d * d);
        }

        return density / (Math.PI * (mirrored + scattered));
    }

    /// <summary>The brightness of a colour in linear light, by ITU-R BT.709.</summary>
    public static double Luminance(Vector colour) => (0.2126 * colour.X) + (0.7152 * colour.Y) + (0.0722 * colour.Z);

    /// <summary>The part of facets that others don't hide, by Smith.</summary>
    private static double Shadowing(double cosine, double alphaSquared) =>
        2 * cosine / (cosine + Math.Sqrt(alphaSquared + ((1 - alphaSquared) * cosine * cosine)));

    private static Vector Fresnel(Vector specular, double cosine)
    {
        var rest = Math.Clamp(1 - cosine, 0, 1);
        var power = rest * rest * (rest * rest) * rest;
        return specular + (power * (Vector.One - specular));
    }

    /// <summary>Samples the normal of a facet that is visible from a direction. Both in axes whose z is the normal.</summary>
    private static Vector VisibleFacet(Vector toEye, double alpha, (double U, double V) point)
    {
        var stretched = new Vector(alpha * toEye.X, alpha * toEye.Y, toEye.Z).UnitVector();
        var axes = AxesAround(stretched);
        var radius = Math.Sqrt(point.U);
        var angle = 2 * Math.PI * point.V;
        var x = radius * Math.Cos(angle);
        var share = 0.5 * (1 + stretched.Z);
        var y = ((1 - share) * Math.Sqrt(Math.Max(0, 1 - (x * x)))) + (share * radius * Math.Sin(angle));
        // The axes are those around the stretched direction: the second must lie in the plane of it and of the normal.
        var first = stretched.Z < 0.9999 ? Vector.Cross(Vector.K, stretched).UnitVector() : axes.V1;
        var second = Vector.Cross(stretched, first);
        var normal = (x * first) + (y * second) + (Math.Sqrt(Math.Max(0, 1 - (x * x) - (y * y))) * stretched);
        return new Vector(alpha * normal.X, alpha * normal.Y, Math.Max(1e-9, normal.Z)).UnitVector();
    }

    /// <summary>Chooses a unit direction of a cone, each as likely as another.</summary>
    /// <param name="axes">Orthonormal axes whose third is in the middle, see <see cref="AxesAround"/>.</param>
    /// <param name="cosine">Cosine of the largest angle with the axis.</param>
    /// <param name="point">A point of the unit square.</param>
    public static Vector SampleCone(in Matrix axes, double cosine, (double U, double V) point)
    {
        var z = 1 - (point.U * (1 - cosine));
        var radius = Math.Sqrt(Math.Max(0, 1 - (z * z)));
        var (sine, cosineAround) = Math.SinCos(2 * Math.PI * point.V);
        return axes * new Vector(radius * cosineAround, radius * sine, z);
    }

    /// <summary>Orthonormal axes whose third is a unit vector, after Duff and others, JCGT 2017.</summary>
    public static Matrix AxesAround(Vector normal)
    {
        var sign = double.CopySign(1, normal.Z);
        var a = -1 / (sign + normal.Z);
        var b = normal.X * normal.Y * a;
        return new(
            new(1 + (sign * normal.X * normal.X * a), sign * b, -sign * normal.X),
            new(b, sign + (normal.Y * normal.Y * a), -normal.Y),
            normal);
    }
}
