using System.Collections.Immutable;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Render.Passes;

namespace FractalEngine.Render.Tracing;

/// <summary>The lights of a scene as the path tracer samples them, with the intensities of drawn frames.</summary>
/// <remarks>
/// An intensity of 1 shows a white surface white: it stands for the irradiance π, since a matt white surface sends 1/π of the irradiance in
/// each direction. The ambient light is the radiance of the surroundings.
/// </remarks>
internal sealed class TracedLights
{
    private readonly ImmutableArray<Light> _lights;
    private readonly Vector _colourAtHorizon;
    private readonly Vector _colourSlope;
    private readonly Sky? _sky;

    /// <summary>Prepares the lights of a scene, or the default ones where it declares none.</summary>
    public TracedLights(LoadedScene scene)
    {
        _lights = LightBlock.LightsOf(scene);
        var (sky, ground, _) = SceneAmbient.OfLights(scene.Scene);
        _sky = scene.Scene.Sky;
        // Irradiance on a surface that faces upwards by the cosine c is then that of the drawn mixture (1 + c)/2 of sky and ground.
        _colourAtHorizon = 0.5 * (sky + ground);
        _colourSlope = 0.75 * (sky - ground);
        Count = _lights.Length;
    }

    /// <summary>Number of lights that are sampled.</summary>
    public int Count { get; }

    /// <summary>The radiance of the surroundings in a direction.</summary>
    public Vector Surroundings(Vector unitDirection)
    {
        var lights = Vector.Max(_colourAtHorizon + (unitDirection.Y * _colourSlope), Vector.Zero);
        return _sky is null ? lights : lights + _sky.Radiance(unitDirection.Y);
    }

    /// <summary>Computes the irradiance, divided by π, that a light brings to a surface which faces it, without shadows.</summary>
    /// <param name="index">Index of the light.</param>
    /// <param name="position">World space.</param>
    /// <param name="samples">Choose a point of a light that has a size.</param>
    /// <param name="toLight">Unit direction towards the light.</param>
    /// <param name="distance">Distance of the light; infinite for parallel light.</param>
    public Vector Incoming(int index, Vector position, ref SampleSequence samples, out Vector toLight, out double distance)
    {
        var light = _lights[index];
        var colour = light.Intensity * TracedMaterial.ToLinear(light.Colour);
        if (light is DirectionalLight directional)
        {
            toLight = -directional.Direction.UnitVector();
            if (directional is SunLight { Diameter: > 0 and var diameter })
            {
                toLight = Reflection.SampleCone(toLight, Math.Cos(diameter * Math.PI / 360), samples.Next());
            }

            distance = double.PositiveInfinity;
            return colour;
        }

        var point = (PointLight)light;
        var difference = point.Position - position;
        distance = difference.Length();
        toLight = distance > 0 ? difference / distance : Vector.J;
        var strength = Falloff(distance, point.Range);
        if (light is SpotLight spot)
        {
            var halfAngle = 0.5 * spot.Angle * Math.PI / 180;
            strength *= SmoothStep(
                Math.Cos(halfAngle), Math.Cos(0.9 * halfAngle), -Vector.Dot(toLight, spot.Direction.UnitVector()));
        }

        return strength * colour;
    }

    /// <summary>As in lighting.glsl: by the inverse square, 1 at a tenth of the range, 0 from the range on.</summary>
    private static double Falloff(double distance, double range)
    {
        var relative = Math.Max(distance / range, 1e-4);
        var squared = relative * relative;
        var window = Math.Clamp(1 - (squared * squared), 0, 1);
        return 0.01 / squared * window * window / (0.9999 * 0.9999);
    }

    private static double SmoothStep(double start, double end, double value)
    {
        var t = Math.Clamp((value - start) / (end - start), 0, 1);
        return t * t * (3 - (2 * t));
    }
}
