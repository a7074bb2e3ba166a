using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Queries;
using FractalEngine.Core.Scenes.Lights;

namespace FractalEngine.Render.Tracing;

/// <summary>The light of suns and lamps that haze scatters once towards the eye.</summary>
/// <remarks>
/// Haze dims the way from where the light is scattered to the eye, and not the one from the light, as on surfaces. One point of the way
/// serves all parallel lights, and each lamp has one of its own.
/// </remarks>
/// <param name="fog">Haze that scatters.</param>
/// <param name="lights">Lights of the scene.</param>
/// <param name="scene">Casts the shadows.</param>
/// <param name="eye">Where positions of the traced scene are relative to, world space.</param>
/// <param name="unit">Their unit, in units of world space.</param>
internal sealed class TracedAir(Fog fog, TracedLights lights, TracedScene scene, Vector eye, double unit)
{
    // Nearer to a lamp than this part of its range its light does not grow.
    private const double LampRadiusByRange = 1e-4;

    /// <summary>The part of light that the air on a way returns, before what is behind it.</summary>
    /// <param name="distance">Length of the way, in the traced scene; may be infinite.</param>
    public double AlbedoOf(double distance) => fog.Albedo * (1 - Math.Exp(-fog.Density * unit * distance));

    /// <summary>Samples the light that is scattered between the eye and a surface.</summary>
    /// <param name="ray">From the eye, in the space of the traced scene.</param>
    /// <param name="footprint">How wide the ray is.</param>
    /// <param name="distance">Distance of the surface along the ray; infinite where there is none.</param>
    /// <param name="samples">Choose points of the way, and of lights that have a size.</param>
    /// <param name="context">Memory of the rays.</param>
    public Vector Scattered(Ray ray, RayFootprint footprint, double distance, ref SampleSequence samples, QueryContext context)
    {
        var (origin, length) = (eye + (unit * ray.Origin), unit * distance);
        var sun = SampleSun(samples.NextNumber(), fog.Density, length);
        var sum = Vector.Zero;
        foreach (var (index, emitter) in lights.Emitters.Index())
        {
            var (passed, weight) = emitter.Position is { } position
                ? SampleLamp(samples.NextNumber(), fog.Density, length, position - origin, ray.Direction, emitter.Range)
                : sun;
            var incoming = weight * lights.Incoming(
                index, origin + (passed * ray.Direction), ref samples, out var toLight, out var lightDistance);
            if (incoming != Vector.Zero)
            {
                // In the unit of a deep zoom, air outside is too far away for rays, and for shadows.
                var tracedDistance = passed / unit;
                var visible = double.IsFinite(tracedDistance)
                    ? scene.Transmittance(
                        new(ray.Origin + (tracedDistance * ray.Direction), toLight),
                        new(footprint.RadiusAt(tracedDistance), TracedLights.ShadowSpread), lightDistance / unit, context)
                    : 1;
                sum += visible * fog.Phase(Vector.Dot(toLight, ray.Direction)) * incoming;
            }
        }

        // An intensity of 1 stands for the irradiance π.
        return Math.PI * fog.Albedo * sum;
    }

    /// <summary>Chooses a point of a way as often as light is lost there, on its way to the eye.</summary>
    /// <param name="number">From 0 to below 1.</param>
    /// <param name="density">Density of the haze.</param>
    /// <param name="length">Length of the way; may be infinite.</param>
    /// <returns>Distance of the point, and the lost part of light, by the density with which that is chosen.</returns>
    internal static (double Distance, double Weight) SampleSun(double number, double density, double length)
    {
        var lost = 1 - Math.Exp(-density * length);
        return (-Math.Log(1 - (number * lost)) / density, lost);
    }

    /// <summary>
    /// Chooses a point of a way by the angle at which a lamp sees it, within the lamp's range (C. Kulla and M. Fajardo, "Importance
    /// Sampling Techniques for Path Tracing in Participating Media", EGSR 2012).
    /// </summary>
    /// <param name="number">From 0 to below 1.</param>
    /// <param name="density">Density of the haze.</param>
    /// <param name="length">Length of the way; may be infinite.</param>
    /// <param name="toLamp">From the start of the way to the lamp.</param>
    /// <param name="direction">Unit direction of the way.</param>
    /// <param name="range">Radius of what the lamp lights.</param>
    /// <returns>Distance of the point, and the lost part of light, by the density with which it is chosen.</returns>
    internal static (double Distance, double Weight) SampleLamp(
        double number, double density, double length, Vector toLamp, Vector direction, double range)
    {
        var closest = Vector.Dot(toLamp, direction);
        var aside = (toLamp - (closest * direction)).Length();
        var halfWay = Math.Sqrt(Math.Max(0, (range * range) - (aside * aside)));
        var width = Math.Max(aside, LampRadiusByRange * range);
        var first = Math.Atan((Math.Max(closest - halfWay, 0) - closest) / width);
        var angle = Math.Atan((Math.Min(closest + halfWay, length) - closest) / width) - first;
        var tangent = Math.Tan(first + (number * angle));
        var distance = closest + (width * tangent);
        return (distance, angle > 0 ? angle * width * (1 + (tangent * tangent)) * density * Math.Exp(-density * distance) : 0);
    }
}
