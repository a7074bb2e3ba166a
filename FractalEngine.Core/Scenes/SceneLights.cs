using System.Collections.Immutable;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Core.Scenes.Lights;

namespace FractalEngine.Core.Scenes;

/// <summary>The lights that shine from somewhere in a scene: its own, or the default ones.</summary>
public static class SceneLights
{
    /// <summary>Lists the lights of a scene that shine from somewhere, in its order.</summary>
    /// <param name="scene">Scene that declares lights, or whose bounds place the default ones.</param>
    public static IEnumerable<Emitter> Of(LoadedScene scene)
    {
        ArgumentNullException.ThrowIfNull(scene);
        var lights = SceneAmbient.UsesDefaultLights(scene.Scene)
            ? DefaultLights(scene.Bounds, scene.Scene.Handedness)
            : scene.Scene.Lights;
        return lights.Select(static light => light.ToEmitter()).OfType<Emitter>();
    }

    /// <summary>
    /// Returns a warm key light from the upper left and a weak cool one from the right, so that three sides of a cube differ.
    /// </summary>
    /// <param name="bounds">Bounds of the scene, world space.</param>
    /// <param name="handedness">How the scene is shown: the lights stand on the same sides of the image in both.</param>
    /// <remarks>The key light is near enough for its falloff to show, so that a large flat face does not look like paper.</remarks>
    private static ImmutableArray<Light> DefaultLights(BoundingBox bounds, Handedness handedness)
    {
        var key = handedness.Mirror(new Vector(-0.42, 0.80, -0.62)).UnitVector();
        var distance = 1.8 * bounds.FiniteDiagonalOr(1);
        return
        [
            // At a tenth of its range, which is the scene's centre, it has its full intensity.
            new PointLight(bounds.Centre + (distance * key), new(1, 0.975, 0.93), 0.80, 10 * distance),
            new DirectionalLight(handedness.Mirror(new(-0.85, -0.2, 0.35)), new(0.86, 0.89, 1), 0.24),
        ];
    }
}
