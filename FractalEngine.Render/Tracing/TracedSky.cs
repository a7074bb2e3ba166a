using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Queries;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Scenes.Lights;

namespace FractalEngine.Render.Tracing;

/// <summary>
/// The light of an image of the sky: one direction is chosen at each surface, and weighed against the chance that the path leads there by
/// itself, as <see cref="TracedAreaLights"/> does with faces.
/// </summary>
internal sealed class TracedSky(ImageRadiance sky)
{
    /// <summary>Prepares the sky of a scene; null for one of colours, which paths find well, and for a black one.</summary>
    public static TracedSky? CreateOrNull(Scene scene) =>
        scene.Sky?.ToRadiance(scene.Handedness) is ImageRadiance { Image.Distribution.IsEmpty: false } sky ? new(sky) : null;

    /// <summary>Samples the light that reaches a surface from the sky, and goes on towards the eye.</summary>
    /// <param name="surface">The surface.</param>
    /// <param name="origin">Point just before it.</param>
    /// <param name="toEye">Unit direction towards the eye.</param>
    /// <param name="footprint">How wide rays are that leave the surface.</param>
    /// <param name="scene">Casts the shadows.</param>
    /// <param name="samples">Choose the direction.</param>
    /// <param name="context">Memory of the rays.</param>
    public Vector Reflected(
        in TracedSurface surface, Vector origin, Vector toEye, RayFootprint footprint, TracedScene scene, ref SampleSequence samples,
        QueryContext context)
    {
        var (u, v) = sky.Image.Distribution.Sample(samples.Next());
        var direction = sky.DirectionOf(u, v);
        var reflected = Reflection.Evaluate(in surface, toEye, direction);
        if (reflected == Vector.Zero)
        {
            return Vector.Zero;
        }

        var transmittance = scene.Transmittance(
            new(origin, direction), footprint, double.PositiveInfinity, context, out var passesGlass);
        // Paths find what is behind glass, which bends them.
        var light = passesGlass ? Vector.Zero : transmittance * sky.At(direction);
        var density = sky.Image.Distribution.Density(u, v) + Reflection.Density(in surface, toEye, direction);
        return reflected.Stretch(light) / (Math.PI * density);
    }

    /// <summary>Computes the weight of the light of the sky where a path leads there by itself.</summary>
    /// <param name="direction">Unit direction of the path.</param>
    /// <param name="reflectionDensity">How likely the last reflection chooses it, per solid angle.</param>
    public double WeightOf(Vector direction, double reflectionDensity)
    {
        var (u, v) = sky.PlaceOf(direction);
        var density = sky.Image.Distribution.Density(u, v);
        return density > 0 ? reflectionDensity / (reflectionDensity + density) : 1;
    }
}
