#:project ../FractalEngine.Render/FractalEngine.Render.csproj
#:property PublishAot=false
// Draws a fractal tree and a sphere into out/scene.png without a window. Drawing needs a display, such as xvfb-run gives.
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Generation;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Views;
using FractalEngine.Render;
using FractalEngine.Render.Images;
using FractalEngine.Render.Views;

Transformation[] twigs =
[
    Transformation.Identity,
    new(new(0, 1, 0), new(0, 0, 30), 0.7 * Vector.One),
    new(new(0, 1, 0), new(0, 120, -25), 0.7 * Vector.One),
];
var tree = Fractal.Of(Shapes.Box(new(new(-0.05, 0, -0.05), new(0.05, 1, 0.05)))).Repeat(twigs, depth: 12);
var scene = new Scene
{
    Background = new(0.9, 0.95, 1),
    Objects =
    [
        new(tree) { Colour = new(0.3, 0.5, 0.2), Gradient = new(GradientKind.Level, new(0.9, 0.7, 0.2)) },
        new(Shapes.Sphere()) { Placement = Transformation.At(new(1.2, 0.4, 0), scale: 0.4), Colour = new(0.8, 0.2, 0.2) },
    ],
};

Directory.CreateDirectory("out");
using var renderer = Renderer.Offscreen(800, 600, new() { Shading = Shading.PerPixel });
var image = renderer.Draw(scene, CameraFraming.Default(scene, aspect: 800.0 / 600));
image.SavePng("out/scene.png");
Console.WriteLine($"{image.Width} x {image.Height} pixels of {tree.InstanceCount} instances and a sphere");

// Output:
// 800 x 600 pixels of 531441 instances and a sphere
