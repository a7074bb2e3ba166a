using FractalEngine.Benchmarks.Measuring;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Core.Views;
using FractalEngine.Render.Views;

namespace FractalEngine.Benchmarks.Drawing;

/// <summary>A frame whose cost is measured: a fractal and a view of it.</summary>
/// <param name="Name">A name for tables.</param>
/// <param name="Scene">A scene of the fractal alone.</param>
/// <param name="View">Camera and projection of the frame.</param>
internal sealed record FrameCase(string Name, LoadedScene Scene, View View)
{
    /// <summary>Width of all measured frames in pixels.</summary>
    public const int Width = 1280;

    /// <summary>Height of all measured frames in pixels.</summary>
    public const int Height = 720;

    /// <summary>Width of all measured frames divided by their height.</summary>
    public const double Aspect = (double)Width / Height;

    // Less than a thousandth of a pixel, but another view: nothing may be reused from the frame before.
    private const double CameraPerturbation = 1e-9;

    /// <summary>Creates the frame of a fractal seen from <c>afar</c>, <c>close</c> or <c>inside</c>.</summary>
    /// <param name="text">Name, depth if wanted, and viewpoint, as in <c>menger:5:inside</c>.</param>
    public static FrameCase Parse(string text)
    {
        var words = text.Split(':');
        var fractal = FractalCase.Parse(string.Join(':', words[..^1]));
        var model = new FractalModel(fractal.Fractal) { SourcePath = fractal.Name };
        var scene = new LoadedScene(new Scene(), [new PlacedModel(new SceneObject(fractal.Name, Transformation.Identity), model)]);
        return new($"{fractal.Name} {words[^1]}", scene, View.Of(scene, Aspect, CreateCamera(words[^1], scene.Bounds)));
    }

    /// <summary>Returns the view with the camera moved by less than a thousandth of a pixel where the number is odd.</summary>
    public View PerturbedView(int drawCount)
    {
        var camera = View.Camera;
        return View with { Camera = camera with { Position = camera.Position + (CameraPerturbation * (drawCount % 2) * Vector.One) } };
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
