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

    /// <summary>Puts an object onto the stage.</summary>
    /// <param name="declared">The only object.</param>
    /// <param name="handedness">How it is shown: the sun stands on the same side of the image in both.</param>
    public static Scene Of(SceneObject declared, Handedness handedness) => new()
    {
        Handedness = handedness,
        Objects = [HasColours(declared.Model!) ? declared : declared with { Gradient = Colours }],
        Sky = new ColourSky(new(0.36, 0.46, 0.62), new(0.8, 0.82, 0.84), new(0.3, 0.28, 0.27)),
        Lights = [new SunLight(handedness.Mirror(new(0.72, -0.62, 0.3)), new(1, 0.92, 0.8), 2.1)],
        Tone = Tone.Filmic,
    };

    private static bool HasColours(Model model) =>
        model is not FractalModel { Fractal.HasColours: false, Gradient: null } fractal || !model.Materials.IsEmpty
        || fractal.MaterialsByMesh.Any(static materials => !materials.IsEmpty);
}
