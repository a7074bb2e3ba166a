using System.Collections.Immutable;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes.Lights;

namespace FractalEngine.Core.Scenes;

/// <summary>
/// The light of a scene that comes from all around: its ambient lights and its sky, or the default of a scene without lights.
/// </summary>
/// <param name="Above">Linear light on a surface that faces upwards, less the curvature.</param>
/// <param name="Below">Likewise of one that faces downwards.</param>
/// <param name="Curvature">
/// A surface whose normal has the height c is lit by (1 + c)/2 of the one, (1 − c)/2 of the other, and c² of this.
/// </param>
/// <param name="Sides">What a sky that differs from side to side adds, see <see cref="SkyIrradiance"/>; empty for others.</param>
public readonly record struct SceneAmbient(Vector Above, Vector Below, Vector Curvature, ImmutableArray<Vector> Sides)
{
    /// <summary>Whether no light comes from all around.</summary>
    public bool IsDark => Above == Vector.Zero && Below == Vector.Zero && Curvature == Vector.Zero && Sides.IsEmpty;

    /// <summary>Adds up what a scene declares, its sky included.</summary>
    public static SceneAmbient Of(Scene scene)
    {
        ArgumentNullException.ThrowIfNull(scene);
        var lights = OfLights(scene);
        if (scene.Sky is not { } sky)
        {
            return lights;
        }

        var (constant, linear, quadratic, sides) = sky.ToRadiance(scene.Handedness).Irradiance();
        return new(lights.Above + constant + linear, lights.Below + constant - linear, quadratic, sides);
    }

    /// <summary>Adds up the ambient lights. A scene without any light has the light of a sky over dry ground.</summary>
    public static SceneAmbient OfLights(Scene scene)
    {
        ArgumentNullException.ThrowIfNull(scene);
        if (UsesDefaultLights(scene))
        {
            return new(new(0.23, 0.245, 0.28), new(0.11, 0.10, 0.095), Vector.Zero, []);
        }

        var sum = scene.Lights.Where(static light => light.ToEmitter() is null)
            .Aggregate(Vector.Zero, static (sum, light) => sum + light.Radiance);
        return new(sum, sum, Vector.Zero, []);
    }

    /// <summary>Whether a scene is lit by the default lights, since it declares none of any kind.</summary>
    internal static bool UsesDefaultLights(Scene scene) => scene.Lights.IsEmpty && scene.Sky is null;
}
