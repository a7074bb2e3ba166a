using System.Collections.Immutable;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Queries;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Scenes.Lights;
using FractalEngine.Render.Lights;

namespace FractalEngine.Render.Tracing;

/// <summary>
/// The lights of a scene without a surface, as the path tracer samples them, with the intensities of drawn frames. The others are
/// <see cref="TracedLamps"/>.
/// </summary>
/// <remarks>
/// An intensity of 1 shows a white surface white: it stands for the irradiance π, since a matt white surface sends 1/π of the irradiance in
/// each direction. The ambient light is the radiance of the surroundings.
/// </remarks>
internal sealed class TracedLights
{
    /// <summary>How much wider rays towards a light become: what they meet may be far away.</summary>
    public const double ShadowSpread = 1e-3;

    // Around the direction towards each light that is parallel.
    private readonly Matrix[] _axes;
    private readonly Surroundings _surroundings;

    /// <summary>Prepares the lights of a scene, or the default ones where it declares none.</summary>
    public TracedLights(LoadedScene scene)
    {
        Emitters = [.. LightBlock.LightsOf(scene).Where(static emitter => !emitter.HasSurface)];
        _axes = [.. Emitters.Select(static emitter => FacetAlbedo.AxesAround(-emitter.Axis))];
        _surroundings = new(scene.Scene);
        Sky = TracedSky.CreateOrNull(scene.Scene);
    }

    /// <summary>Lights without a surface, all of which are sampled at each surface of a path.</summary>
    public ImmutableArray<Emitter> Emitters { get; }

    /// <summary>The image of the sky, which is sampled; null for none.</summary>
    public TracedSky? Sky { get; }

    /// <summary>The radiance of the surroundings in a direction.</summary>
    /// <param name="unitDirection">World space.</param>
    /// <param name="skyPart">How much of the sky counts.</param>
    public Vector Surroundings(Vector unitDirection, double skyPart) => _surroundings.At(unitDirection, skyPart: skyPart);

    /// <summary>Computes the irradiance, divided by π, that a light brings to a surface which faces it, without shadows.</summary>
    /// <param name="index">Index of the light.</param>
    /// <param name="position">World space.</param>
    /// <param name="samples">Choose a point of a light that has a size.</param>
    /// <param name="toLight">Unit direction towards the light.</param>
    /// <param name="distance">Distance of the light; infinite for parallel light.</param>
    public Vector Incoming(int index, Vector position, ref SampleSequence samples, out Vector toLight, out double distance)
    {
        var emitter = Emitters[index];
        var incoming = emitter.Incoming(position, out toLight, out distance);
        if (emitter.Diameter > 0)
        {
            toLight = Reflection.SampleCone(in _axes[index], emitter.DiscCosine, samples.Next());
        }

        return incoming;
    }

    /// <summary>Adds up the light that reaches a surface from all lights, and goes on towards the eye.</summary>
    /// <param name="surface">The surface.</param>
    /// <param name="position">Its place in world space.</param>
    /// <param name="origin">Point just before it, in the space of the traced scene.</param>
    /// <param name="toEye">Unit direction towards the eye.</param>
    /// <param name="width">Radius of the rays there.</param>
    /// <param name="scene">Casts the shadows.</param>
    /// <param name="unit">Unit of the traced scene's space, in units of world space.</param>
    /// <param name="samples">Choose points of lights that have a size.</param>
    /// <param name="context">Memory of the rays.</param>
    public Vector Reflected(
        in TracedSurface surface, Vector position, Vector origin, Vector toEye, double width, TracedScene scene, double unit,
        ref SampleSequence samples, QueryContext context)
    {
        var sum = Vector.Zero;
        for (var i = 0; i < Emitters.Length; i++)
        {
            var incoming = Incoming(i, position, ref samples, out var toLight, out var distance);
            var reflected = incoming.Stretch(Reflection.Evaluate(in surface, toEye, toLight));
            if (reflected != Vector.Zero)
            {
                sum += scene.Transmittance(new(origin, toLight), new(width, ShadowSpread), distance / unit, context) * reflected;
            }
        }

        return sum;
    }
}
