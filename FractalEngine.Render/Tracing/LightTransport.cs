using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Queries;

namespace FractalEngine.Render.Tracing;

/// <summary>Follows paths of light through a scene, and finds the light along them.</summary>
/// <param name="scene">The surfaces.</param>
/// <param name="lights">What shines from beyond them.</param>
/// <param name="background">What the eye sees behind them.</param>
/// <param name="eye">Where positions of the traced scene are relative to, world space: zero unless the view is a deep zoom.</param>
/// <param name="unit">Their unit, in units of world space.</param>
internal sealed class LightTransport(
    TracedScene scene, TracedLights lights, TracedBackground background, Vector eye, double unit)
{
    // From this bounce on, dark paths end by chance.
    private const int FirstRouletteBounce = 3;

    // How much wider rays of scattered light become: their images are soft.
    private const double ScatteredSpread = 0.03;

    private readonly TracedAreaLights? _areaLights = scene.AreaLights;
    private readonly TracedLamps? _lamps = scene.Lamps;
    private readonly TracedSky? _sky = lights.Sky;

    /// <summary>Density of the fog, per unit of the traced scene.</summary>
    public double FogDensity { get; init; }

    /// <summary>Radiance of fog that nothing is seen through.</summary>
    public Vector FogColour { get; init; }

    /// <summary>What scatters light before the first surface; null for nothing.</summary>
    public TracedAir? Air { get; init; }

    /// <summary>Follows one path, and returns the radiance that comes along it.</summary>
    /// <param name="path">From the eye.</param>
    /// <param name="bounceLimit">Number of surfaces that it goes on from.</param>
    /// <param name="samples">The points of the sample.</param>
    /// <param name="context">Memory of the rays.</param>
    /// <param name="first">What the path meets first.</param>
    public Vector Follow(
        ref LightPath path, int bounceLimit, ref SampleSequence samples, QueryContext context, out FirstHit first)
    {
        first = default;
        while (true)
        {
            var ray = path.Ray;
            if (!scene.TryIntersect(in ray, path.Footprint, path.Clip.Near, path.Clip.Far, context, out var surface))
            {
                path.Radiance += path.Throughput.Stretch(
                    path.Bounces == 0 ? background.At(ray.Direction) : lights.Surroundings(ray.Direction, PartOfSky(in path)));
                first = path.IsFirst ? new(path.Radiance, AlbedoOfAir(double.PositiveInfinity), Vector.Zero, 0) : first;
                AddAir(ref path, double.PositiveInfinity, ref samples, context);
                return path.Radiance;
            }

            var passed = (surface.Position - ray.Origin).Length();
            // An eye within glass learns it from the first surface.
            path.Medium ??= surface.IsInside ? surface.Glass : null;
            if (path.Medium is { } medium)
            {
                path.Throughput = path.Throughput.Stretch(medium.TransmissionOver(unit * passed));
            }

            if (surface.Glass is null && surface.Opacity < 1 && !(samples.NextNumber() < surface.Opacity))
            {
                if (!path.TryPassLayer(passed + scene.OffsetAt(surface.Position)))
                {
                    return path.Radiance;
                }

                continue;
            }

            AddFog(ref path, passed);
            AddEmission(ref path, in surface, context);
            if (path.IsFirst)
            {
                var distance = path.DistanceBefore + passed;
                first = new(
                    path.Radiance, AlbedoOfAir(distance) + path.Throughput.Stretch(surface.Albedo), surface.Normal, distance);
            }

            AddAir(ref path, passed, ref samples, context);

            var width = path.WidthAt(passed);
            var origin = surface.Position + (scene.OffsetAt(surface.Position) * surface.FaceNormal);
            if (!surface.IsInside)
            {
                path.Radiance += path.Throughput.Stretch(lights.Reflected(
                    in surface, eye + (unit * surface.Position), origin, -ray.Direction, width, scene, unit, ref samples, context));
            }

            if (surface.Glass is { } glass)
            {
                if (!path.TryMeetGlass())
                {
                    return path.Radiance;
                }

                // The eye sees lamps in glass by itself.
                if (_lamps is not null && path.Bounces > 0 && !surface.IsInside)
                {
                    path.Radiance += path.Throughput.Stretch(_lamps.Reflected(
                        surface with { Colour = Vector.Zero }, origin, -ray.Direction, width, isAlone: true, scene, ref samples, context));
                }

                if (TryPassGlass(ref path, glass, in surface, origin, width, ref samples))
                {
                    continue;
                }

                // Scattered by what is not clear.
                surface = surface with { Gloss = null, Colour = surface.Colour / surface.Opacity };
            }

            if (_lamps is not null)
            {
                path.Radiance += path.Throughput.Stretch(_lamps.Reflected(
                    in surface, origin, -ray.Direction, width, path.Bounces >= bounceLimit, scene, ref samples, context));
            }

            if (path.Bounces >= bounceLimit || !TryReflect(ref path, in surface, origin, width, ref samples, context))
            {
                return path.Radiance;
            }
        }
    }

    /// <summary>Adds the fog before the first surface.</summary>
    private void AddFog(ref LightPath path, double passed)
    {
        if (FogDensity > 0 && path.IsFirst)
        {
            var clear = Math.Exp(-FogDensity * (path.DistanceBefore + passed));
            path.Radiance = (1 - clear) * FogColour;
            path.Throughput *= clear;
        }
    }

    /// <summary>The part of light that the air before the first surface returns.</summary>
    private Vector AlbedoOfAir(double distance) => Air is null ? Vector.Zero : Air.AlbedoOf(distance) * Vector.One;

    /// <summary>Adds the light that is scattered before the first surface, or before the background.</summary>
    private void AddAir(ref LightPath path, double passed, ref SampleSequence samples, QueryContext context)
    {
        if (Air is not null && path.IsFirst)
        {
            // From the eye on, which layers that the path has passed are behind.
            var (ray, footprint, before) = (path.Ray, path.Footprint, path.DistanceBefore);
            path.Radiance += Air.Scattered(
                ray with { Origin = ray.Origin - (before * ray.Direction) }, footprint with { Radius = footprint.RadiusAt(-before) },
                before + passed, ref samples, context);
        }
    }

    /// <summary>Adds the light of an emissive surface, weighed where it could have been sampled, too.</summary>
    private void AddEmission(ref LightPath path, in TracedSurface surface, QueryContext context)
    {
        if (surface.Lamp is { } lamp)
        {
            path.Radiance += path.Throughput.Stretch(LightOf(lamp, in path, surface.Position));
        }
        else if (surface.Emission != Vector.Zero)
        {
            // Lamps behind glass are not sampled.
            var weight = path.Bounces == 0 || path.IsThroughGlass || _areaLights is null ? 1
                : _areaLights.WeightOf(
                    in surface, path.ReflectorNormal, path.ReflectedFrom, path.Ray.Direction, path.ReflectionDensity, context);
            path.Radiance += weight * path.Throughput.Stretch(surface.Emission);
        }
    }

    /// <summary>
    /// The light of a lamp that a path meets: whole for the eye, none behind glass, which lets sampled light through, else weighed.
    /// </summary>
    private static Vector LightOf(TracedLamp lamp, in LightPath path, Vector position)
    {
        var (origin, density) = (path.ReflectedFrom, path.ReflectionDensity);
        return path.Bounces == 0 ? lamp.Emitter.SurfaceRadiance : path.IsThroughGlass ? Vector.Zero
            : density / (density + lamp.Density(origin, path.Ray.Direction, (position - origin).Length())) * lamp.RadianceAt(origin);
    }

    /// <summary>How much of the sky counts that a path meets: all of it behind glass, where it is not sampled, else weighed.</summary>
    private double PartOfSky(in LightPath path) =>
        _sky is null || path.IsThroughGlass ? 1 : _sky.WeightOf(path.Ray.Direction, path.ReflectionDensity);

    /// <summary>Lets glass mirror or refract a path; false where the path is scattered instead.</summary>
    private bool TryPassGlass(
        ref LightPath path, Glass glass, in TracedSurface surface, Vector origin, double width, ref SampleSequence samples)
    {
        var direction = glass.Sample(in surface, -path.Ray.Direction, ref samples, out var isRefracted);
        if (isRefracted && surface.Opacity != 0 && samples.NextNumber() < surface.Opacity)
        {
            return false;
        }

        path.Medium = isRefracted == surface.IsInside ? null : glass;
        path.PassGlass(
            new(isRefracted ? origin - (2 * scene.OffsetAt(surface.Position) * surface.FaceNormal) : origin, direction), width);
        return true;
    }

    /// <summary>
    /// Adds the light of emissive faces and of an image of the sky on a surface, and lets it reflect the path; false where that ends.
    /// </summary>
    private bool TryReflect(
        ref LightPath path, in TracedSurface surface, Vector origin, double width, ref SampleSequence samples, QueryContext context)
    {
        var toEye = -path.Ray.Direction;
        var scattered = new RayFootprint(width, path.Footprint.Spread + ScatteredSpread) { KeepsLamps = _areaLights is not null };
        if (_areaLights is not null)
        {
            path.Radiance += path.Throughput.Stretch(
                _areaLights.Reflected(in surface, origin, toEye, scattered, scene, ref samples, context));
        }

        if (_sky is not null)
        {
            path.Radiance += path.Throughput.Stretch(
                _sky.Reflected(in surface, origin, toEye, scattered, scene, ref samples, context));
        }

        if (!Reflection.TrySample(in surface, toEye, ref samples, out var direction, out var weight, out var spread))
        {
            return false;
        }

        if (_areaLights is not null || _lamps is not null || _sky is not null)
        {
            path.Remember(in surface, origin, Reflection.Density(in surface, toEye, direction));
        }

        var throughput = path.Throughput.Stretch(weight);
        path.Reflect(new(origin, direction), scattered with { Spread = path.Footprint.Spread + (spread * ScatteredSpread) });
        if (path.Bounces >= FirstRouletteBounce)
        {
            var survival = Math.Min(0.95, Math.Max(throughput.X, Math.Max(throughput.Y, throughput.Z)));
            if (!(samples.NextNumber() < survival))
            {
                return false;
            }

            throughput /= survival;
        }

        path.Throughput = throughput;
        return true;
    }
}
