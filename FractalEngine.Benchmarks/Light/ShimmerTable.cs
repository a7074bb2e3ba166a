using FractalEngine.Benchmarks.Measuring;
using FractalEngine.Core.Images;
using FractalEngine.Core.Maths;
using FractalEngine.Parsing.Assets;
using FractalEngine.Render;
using FractalEngine.Render.Views;

namespace FractalEngine.Benchmarks.Light;

/// <summary>
/// How much flickers where nothing moves? Two frames at rest, whose cameras differ by an eighth of a pixel, are compared.
/// </summary>
internal static class ShimmerTable
{
    /// <summary>Names of the table's columns.</summary>
    public static readonly string[] Columns =
        ["scene", "shadows_and_occlusion", "gathered_frames", "percent_by_a_tenth", "percent_by_a_quarter", "mean_change_percent"];

    /// <summary>The scenes that are measured.</summary>
    public static readonly string[] Scenes = ["scenes/menger.sdo", "fractals/tetrahedron.fdo", "scenes/forest.sdo"];

    private const int Width = 1280;
    private const int Height = 720;

    // As a window does unless told otherwise.
    private const int GatheredFrames = 16;

    private const double PartOfPixel = 1.0 / 8;

    /// <summary>Measures one scene, without and with shadows and occlusion: single frames, and what a window gathers at rest.</summary>
    /// <param name="file">Path below the assets.</param>
    public static IEnumerable<object?[]> Measure(string file)
    {
        var scene = AssetLoader.Load(Path.Combine(FractalCase.Assets, file)).Scene;
        var view = View.Of(scene, (double)Width / Height);
        // The eye turns by that part of the angle of a pixel, to the right and upwards.
        var angle = PartOfPixel * 2 * view.HalfHeight / Height;
        var camera = view.Camera;
        var turned = view with { Camera = camera with { Rotation = camera.Rotation + new Vector(angle, angle, 0) } };
        foreach (var (hasLight, frames) in ((bool, int)[])[(false, 1), (true, 1), (false, GatheredFrames), (true, GatheredFrames)])
        {
            var settings = new RenderSettings { Shadows = hasLight, AmbientOcclusion = hasLight, GatheredFrames = frames };
            using var renderer = Renderer.Offscreen(Width, Height, settings);
            var (first, second) = (renderer.Draw(scene, view), renderer.Draw(scene, turned));
            var changes = Enumerable.Range(0, Width * Height).Select(i => Change(first, second, i % Width, i / Width)).ToArray();
            yield return
            [
                Path.GetFileNameWithoutExtension(file), hasLight, frames, Percent(changes.Count(static change => change > 0.1)),
                Percent(changes.Count(static change => change > 0.25)), Math.Round(100 * changes.Average(), 3),
            ];
        }
    }

    private static double Percent(int pixels) => Math.Round(100.0 * pixels / (Width * Height), 3);

    /// <summary>The largest change of a component, as a part of white.</summary>
    private static double Change(PixelImage first, PixelImage second, int x, int y)
    {
        var (before, after) = (first[x, y], second[x, y]);
        return Math.Max(
            Math.Abs(before.Red - after.Red), Math.Max(Math.Abs(before.Green - after.Green), Math.Abs(before.Blue - after.Blue))) / 255.0;
    }
}
