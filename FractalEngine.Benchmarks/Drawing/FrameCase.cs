using FractalEngine.Benchmarks.Measuring;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Render;

namespace FractalEngine.Benchmarks.Drawing;

/// <summary>A picture whose cost is measured: a fractal, and where it is seen from.</summary>
/// <param name="Name">For tables.</param>
/// <param name="Scene">The fractal alone.</param>
/// <param name="View">How it is looked at.</param>
internal sealed record FrameCase(string Name, LoadedScene Scene, View View)
{
    /// <summary>Of all pictures.</summary>
    public const double Aspect = 16.0 / 9;

    /// <summary>A fractal seen from <c>afar</c>, <c>close</c> or <c>inside</c>.</summary>
    /// <param name="text">As in <c>menger:5:inside</c>.</param>
    public static FrameCase Parse(string text)
    {
        var words = text.Split(':');
        var fractal = FractalCase.Parse(string.Join(':', words[..^1]));
        var model = new FractalModel(fractal.Fractal) { SourcePath = fractal.Name };
        var scene = new LoadedScene(new Scene(), [new PlacedModel(new SceneObject(fractal.Name, Transformation.Identity), model)]);
        return new($"{fractal.Name} {words[^1]}", scene, View.Of(scene, Aspect, CreateCamera(words[^1], scene.Bounds)));
    }

    private static Camera CreateCamera(string viewpoint, BoundingBox bounds)
    {
        var afar = CameraFraming.Default(bounds, Aspect);
        return viewpoint switch
        {
            "afar" => afar,
            "close" => afar with { Position = bounds.Centre + (0.55 * (afar.Position - bounds.Centre)) },
            "inside" => new(bounds.Centre + bounds.Size.Stretch(new(0.02, 0.03, -0.1)), new(0.2, 0.4, 0), 60),
            _ => throw new ArgumentException($"expected afar, close or inside, not '{viewpoint}'", nameof(viewpoint)),
        };
    }
}
