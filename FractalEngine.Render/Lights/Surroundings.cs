using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Scenes.Lights;

namespace FractalEngine.Render.Lights;

/// <summary>The light of a scene that comes from all around, for each direction: its ambient lights and its sky.</summary>
internal sealed class Surroundings
{
    private readonly Vector _colourAtHorizon;
    private readonly Vector _colourSlope;
    private readonly SkyRadiance? _sky;

    /// <summary>Prepares the light around a scene.</summary>
    public Surroundings(Scene scene)
    {
        var (sky, ground, _, _) = SceneAmbient.OfLights(scene);
        _sky = scene.Sky?.ToRadiance(scene.Handedness);
        // Irradiance on a surface that faces upwards by the cosine c is then that of the drawn mixture (1 + c)/2 of sky and ground.
        _colourAtHorizon = 0.5 * (sky + ground);
        _colourSlope = 0.75 * (sky - ground);
    }

    /// <summary>The radiance in a direction, or about the mean around it, see <see cref="SkyRadiance.At"/>.</summary>
    /// <param name="unitDirection">World space.</param>
    /// <param name="solidAngle">How much is seen, in steradians.</param>
    /// <param name="skyPart">How much of the sky counts.</param>
    public Vector At(Vector unitDirection, double solidAngle = 0, double skyPart = 1)
    {
        var lights = Vector.Max(_colourAtHorizon + (unitDirection.Y * _colourSlope), Vector.Zero);
        return _sky is { } sky ? lights + (skyPart * sky.At(unitDirection, solidAngle)) : lights;
    }

    /// <summary>Computes what facets of growing roughness mirror of it, as levels of a texture.</summary>
    /// <remarks>
    /// Rows lead from straight above to straight below. Level l has facets of the roughness <see cref="FacetAlbedo.MinRoughness"/> · 2ˡ,
    /// seen along their normal (Karis, SIGGRAPH 2013).
    /// </remarks>
    /// <param name="width">Texels around the horizon in the first level.</param>
    /// <param name="height">Texels from above to below in the first level; a power of two, at least 64.</param>
    /// <returns>Each level: red, green and blue, [height × width × 3].</returns>
    public float[][] Prefilter(int width, int height)
    {
        const int LevelCount = 7;
        return [.. Enumerable.Range(0, LevelCount).Select(level => Prefilter(
            Math.Max(1, width >> level), height >> level, FacetAlbedo.MinRoughness * (1 << level)))];
    }

    private float[] Prefilter(int width, int height, double roughness)
    {
        var mirrored = Mirror(roughness);
        var weights = mirrored.Sum(static sample => sample.Weight);
        var texels = new float[3 * width * height];
        Parallel.For(0, height, row =>
        {
            for (var column = 0; column < width; column++)
            {
                var (sine, cosine) = Math.SinCos((row + 0.5) / height * Math.PI);
                var (around, along) = Math.SinCos(((column + 0.5) / width * 2 * Math.PI) - Math.PI);
                var axes = FacetAlbedo.AxesAround(new(sine * along, cosine, sine * around));
                var sum = Vector.Zero;
                foreach (var (direction, weight, solidAngle) in mirrored)
                {
                    sum += weight * At(axes * direction, solidAngle);
                }

                var target = texels.AsSpan(3 * ((row * width) + column), 3);
                (target[0], target[1], target[2]) =
                    ((float)(sum.X / weights), (float)(sum.Y / weights), (float)(sum.Z / weights));
            }
        });
        return texels;
    }

    /// <summary>The directions from which facets mirror light along their normal, their weights, and the solid angle of each.</summary>
    private static List<(Vector Direction, double Weight, double SolidAngle)> Mirror(double roughness)
    {
        const int Rings = 12;
        const int Spokes = 16;
        var mirrored = new List<(Vector Direction, double Weight, double SolidAngle)>();
        var alphaSquared = roughness * roughness;
        for (var i = 0; i < Rings * Spokes; i++)
        {
            var (ring, spoke) = Math.DivRem(i, Spokes);
            var facet = FacetAlbedo.VisibleFacet(Vector.K, roughness, ((ring + 0.5) / Rings, (spoke + 0.5 + (0.5 * (ring % 2))) / Spokes));
            var direction = (2 * facet.Z * facet) - Vector.K;
            if (direction.Z > 0)
            {
                // Samples are as dense as a quarter of the facets of GGX are. Small suns are not missed, or hit too often, between them
                // (J. Krivanek and M. Colbert, EGSR 2008).
                var d = (facet.Z * facet.Z * (alphaSquared - 1)) + 1;
                mirrored.Add((
                    direction, FacetAlbedo.Shadowing(direction.Z, alphaSquared), 4 * Math.PI * d * d / (alphaSquared * Rings * Spokes)));
            }
        }

        return mirrored;
    }
}
