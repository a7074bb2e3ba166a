using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Core.Scenes.Lights;

namespace FractalEngine.Parsing.Assets;

/// <summary>What is around a mesh or fractal that is opened alone: a pale sky, and a sun from the left behind the camera.</summary>
internal static class Stage
{
    // From its foot to its top. By levels, all of a sponge would have one colour.
    private static readonly Gradient Colours = Gradient.Of(
        GradientKind.Height, Palette.OfEven(new(0.2, 0.34, 0.42), new(0.62, 0.6, 0.5), new(0.95, 0.78, 0.5)));

    // Of what light brings to the middle: more than this would be white in any image.
    private const double MaxLight = 10;

    /// <summary>
    /// Puts the only object of a scene onto the stage. Where its file has lights, those are all that there are; too bright ones, such as
    /// those of lamps in candela, make images find their exposure.
    /// </summary>
    /// <param name="scene">The scene. The sun stands on the same side of the image, whatever its handedness.</param>
    /// <param name="isFractal">Whether the file is that of a fractal, which has colours in any case.</param>
    public static Scene Of(Scene scene, bool isFractal) => !scene.Lights.IsEmpty ? scene with
    {
        HasAutoExposure = scene.Lights.Sum(light => LightAt(light, scene.Objects[0].Model!.Bounds)) > MaxLight,
    } : scene with
    {
        Objects = [.. scene.Objects.Select(one => !isFractal || HasColours(one.Model!) ? one : one with { Gradient = Colours })],
        Sky = new ColourSky(new(0.36, 0.46, 0.62), new(0.8, 0.82, 0.84), new(0.3, 0.28, 0.27)),
        Lights = [new SunLight(scene.Handedness.Mirror(new(0.72, -0.62, 0.3)), new(1, 0.92, 0.8), 2.1)],
        Tone = Tone.Filmic,
    };

    private static double LightAt(Light light, BoundingBox bounds) =>
        light.ToEmitter()?.Incoming(bounds.IsEmpty ? Vector.Zero : bounds.Centre, out _, out _).MaxAbsComponent() ?? 0;

    private static bool HasColours(Model model) =>
        model is not FractalModel { Fractal.HasColours: false, Gradient: null } fractal || !model.Materials.IsEmpty
        || fractal.MaterialsByMesh.Any(static materials => !materials.IsEmpty);
}
