using System.Collections.Immutable;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Queries;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Scenes.Lights;
using FractalEngine.Render.Lights;

namespace FractalEngine.Render.Tracing;

/// <summary>
/// Lights of a scene that have a surface: each is sampled at each surface of a path, and weighed against the chance that the path meets it
/// by itself, as <see cref="TracedAreaLights"/> does. What is before them hides them; they hide what is behind them.
/// </summary>
internal sealed class TracedLamps(ImmutableArray<Emitter> emitters, Vector eye, double unit)
{
    // Rounding may bring a lamp a little nearer than it was found.
    private const double Before = 1 - 1e-6;

    private readonly ImmutableArray<TracedLamp> _lamps =
        [.. emitters.Select(TracedLamp (one) => one.Radius > 0 ? new TracedBall(one, eye, unit) : new TracedQuad(one, eye, unit))];

    /// <summary>Prepares the lights of a scene that have a surface; null where there are none.</summary>
    public static TracedLamps? CreateOrNull(LoadedScene scene)
    {
        ImmutableArray<Emitter> emitters = [.. LightBlock.LightsOf(scene).Where(static emitter => emitter.HasSurface)];
        return emitters.IsEmpty ? null : new(emitters, Vector.Zero, 1);
    }

    /// <summary>The same lights in another space.</summary>
    /// <param name="eye">Its origin, world space.</param>
    /// <param name="unit">Its unit, scene units.</param>
    public TracedLamps RelativeTo(Vector eye, double unit) => new(emitters, eye, unit);

    /// <summary>Finds the nearest lamp along a ray.</summary>
    /// <param name="ray">With a unit direction.</param>
    /// <param name="minDistance">Where the ray begins.</param>
    /// <param name="distance">Where it ends; or the distance of the lamp.</param>
    /// <returns>Null for none.</returns>
    public TracedLamp? FindNearest(in Ray ray, double minDistance, ref double distance)
    {
        TracedLamp? nearest = null;
        foreach (var lamp in _lamps)
        {
            var found = lamp.DistanceAlong(in ray);
            (nearest, distance) = found >= minDistance && found < distance ? (lamp, found) : (nearest, distance);
        }

        return nearest;
    }

    /// <summary>Samples the light that reaches a surface from all lamps, and goes on towards the eye.</summary>
    /// <param name="surface">The surface.</param>
    /// <param name="origin">Point just before it.</param>
    /// <param name="toEye">Unit direction towards the eye.</param>
    /// <param name="width">Radius of the rays there.</param>
    /// <param name="isAlone">True where no path goes on that may meet the lamps too.</param>
    /// <param name="scene">Casts the shadows.</param>
    /// <param name="samples">Choose the points.</param>
    /// <param name="context">Memory of the rays.</param>
    public Vector Reflected(
        in TracedSurface surface, Vector origin, Vector toEye, double width, bool isAlone, TracedScene scene,
        ref SampleSequence samples, QueryContext context)
    {
        var sum = Vector.Zero;
        foreach (var lamp in _lamps)
        {
            if (!lamp.TrySample(origin, samples.Next(), out var toLight, out var distance)
                || Reflection.Evaluate(in surface, toEye, toLight).Stretch(lamp.RadianceAt(origin)) is var light && light == Vector.Zero)
            {
                continue;
            }

            var transmittance = scene.Transmittance(
                new(origin, toLight), new(width, TracedLights.ShadowSpread), Before * distance, context, out var passesGlass);
            // Paths that meet glass on their way are bent.
            var others = isAlone || passesGlass ? 0 : Reflection.Density(in surface, toEye, toLight);
            sum += transmittance / (Math.PI * (lamp.Density(origin, toLight, distance) + others)) * light;
        }

        return sum;
    }
}
