using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Queries;
using FractalEngine.Core.SceneQueries;
using FractalEngine.Core.Scenes;
using FractalEngine.Render.Lights;

namespace FractalEngine.Render.Tracing;

/// <summary>
/// The light of emissive faces: a point of one is sampled at each surface, and weighed against the chance that the path meets it by itself.
/// </summary>
/// <remarks>
/// Multiple importance sampling with the balance heuristic, after E. Veach, "Robust Monte Carlo Methods for Light Transport Simulation",
/// 1997, §9.2. Both ways see the light of the same face along the same ray, which is a line for objects that shine: a proxy would shine by
/// other faces than the parts of a fractal that it stands for. What the sampler never chooses counts whole where a path meets it.
/// </remarks>
internal sealed class TracedAreaLights(AreaLightSampler sampler)
{
    private const int MaxLayers = 64;

    // Digits of a sample's number.
    private const double UnitOfNumber = 1.0 / (1 << 24);

    /// <summary>Prepares the emissive faces of a scene; null where none can be sampled.</summary>
    /// <param name="scene">With its models loaded.</param>
    /// <param name="surfaces">The surface of each part of the models.</param>
    /// <param name="isUniform">True to choose each face with the same probability.</param>
    public static TracedAreaLights? CreateOrNull(LoadedScene scene, IReadOnlyDictionary<Model, TracedModel> surfaces, bool isUniform)
    {
        var sampler = new AreaLightSampler(
            scene, (part, face) => Vector.Dot(DisplayTransform.Luminance, surfaces[part].MaterialOf(face).Emission), isUniform);
        return sampler.IsEmpty ? null : new(sampler);
    }

    /// <summary>Samples the light that reaches a surface from emissive faces, and goes on towards the eye.</summary>
    /// <param name="surface">The surface.</param>
    /// <param name="origin">Point just before it.</param>
    /// <param name="toEye">Unit direction towards the eye.</param>
    /// <param name="footprint">How wide rays are that leave the surface.</param>
    /// <param name="scene">Casts the shadows.</param>
    /// <param name="samples">Choose the face, and the point.</param>
    /// <param name="context">Memory of the rays.</param>
    public Vector Reflected(
        in TracedSurface surface, Vector origin, Vector toEye, RayFootprint footprint, TracedScene scene, ref SampleSequence samples,
        QueryContext context)
    {
        var (first, second) = samples.Next();
        if (!sampler.TrySample(
            origin, surface.Normal, first + (second * UnitOfNumber), samples.Next(), context, out var sample))
        {
            return Vector.Zero;
        }

        var toLight = sample.Position - origin;
        var distance = toLight.Length();
        toLight /= distance;
        var reflected = distance > 0 ? Reflection.Evaluate(in surface, toEye, toLight) : Vector.Zero;
        if (reflected == Vector.Zero || !TryReach(
                in sample, new(origin, toLight), footprint with { KeepsLamps = true }, distance, scene, context, out var light))
        {
            return Vector.Zero;
        }

        var density = DensityOf(in light, surface.Normal, origin, toLight, context) + Reflection.Density(in surface, toEye, toLight);
        return density > 0 ? light.Opacity / (Math.PI * density) * reflected.Stretch(light.Emission) : Vector.Zero;
    }

    /// <summary>Computes the weight of light that a path meets by itself.</summary>
    /// <param name="light">The emissive surface that the last ray has hit.</param>
    /// <param name="normal">Normal for shading of the surface that reflects it.</param>
    /// <param name="origin">Point just before that.</param>
    /// <param name="toLight">Unit direction from there.</param>
    /// <param name="reflectionDensity">How likely the reflection chooses the direction, per solid angle.</param>
    /// <param name="context">That of the ray.</param>
    public double WeightOf(
        in TracedSurface light, Vector normal, Vector origin, Vector toLight, double reflectionDensity, QueryContext context)
    {
        var density = DensityOf(in light, normal, origin, toLight, context);
        return density > 0 ? reflectionDensity / (reflectionDensity + density) : 1;
    }

    /// <summary>Computes how likely a direction is chosen by the face that it leads to, per solid angle.</summary>
    private double DensityOf(in TracedSurface light, Vector normal, Vector origin, Vector toLight, QueryContext context)
    {
        var cosine = Math.Abs(Vector.Dot(light.FaceNormal, toLight));
        return light.FaceIndex < 0 || cosine == 0 ? 0
            : sampler.DensityOf(origin, normal, context, light.FaceIndex) * (light.Position - origin).LengthSquared() / cosine;
    }

    /// <summary>Follows a ray to the point of a face that was chosen.</summary>
    /// <param name="sample">The point.</param>
    /// <param name="ray">From the surface towards it.</param>
    /// <param name="footprint">How wide the ray is.</param>
    /// <param name="distance">Its distance.</param>
    /// <param name="scene">The scene.</param>
    /// <param name="context">That of the choice.</param>
    /// <param name="light">The surface there; its opacity is multiplied by what layers before it let through.</param>
    /// <returns>False where something hides the face.</returns>
    private static bool TryReach(
        in AreaLightSample sample, Ray ray, RayFootprint footprint, double distance, TracedScene scene, QueryContext context,
        out TracedSurface light)
    {
        // Rounding may bring the face a little farther away.
        const double Reach = 1.001;
        distance *= Reach;
        var transmittance = 1.0;
        for (var layer = 0; layer < MaxLayers && scene.TryIntersect(in ray, footprint, 0, distance, context, out light); layer++)
        {
            if (AreaLightSampler.IsFound(in sample, context, light.FaceIndex))
            {
                light = light with { Opacity = transmittance * light.Opacity };
                return true;
            }

            // Paths find what is behind glass, which bends them.
            transmittance *= light.Glass is null ? 1 - light.Opacity : 0;
            var passed = (light.Position - ray.Origin).Length() + scene.OffsetAt(light.Position);
            ray = ray with { Origin = ray.Origin + (passed * ray.Direction) };
            distance -= passed;
            if (!(transmittance > 0) || !(distance > 0))
            {
                break;
            }
        }

        light = default;
        return false;
    }
}
