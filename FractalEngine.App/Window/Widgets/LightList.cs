using System.Globalization;
using FractalEngine.App.Window.Actions;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Core.Scenes.Lights;
using FractalEngine.Parsing.Editing;
using FractalEngine.Render.Ui;

namespace FractalEngine.App.Window.Widgets;

/// <summary>The lights of a scene, in its panel.</summary>
internal sealed class LightList(WindowActions actions)
{
    private int _light = -1;
    private bool _isOpen;

    public void Build(UserInterface ui, Scene scene)
    {
        if (!ui.Branch(string.Create(CultureInfo.InvariantCulture, $"Lights ({scene.Lights.Length})"), ref _isOpen))
        {
            return;
        }

        for (var i = 0; i < scene.Lights.Length; i++)
        {
            var light = scene.Lights[i];
            var index = i;
            ui.Scope($"light {i}", () =>
            {
                ui.Row(1);
                if (ui.Selectable(light.Kind, index == _light, depth: 1))
                {
                    _light = index == _light ? -1 : index;
                }

                if (index == _light)
                {
                    BuildLight(ui, light, index);
                }
            });
        }

        ui.Row(1, 1);
        if (ui.Button("Add a sun"))
        {
            // From behind the default camera.
            actions.ChangeScene(static present => present with
            {
                Lights = present.Lights.Add(new DirectionalLight(present.Handedness.Mirror(new(1, -2, 1)), Colour.White, 0.7)),
            });
        }

        if (ui.Button("Add a lamp"))
        {
            var document = actions.Document!;
            var lamp = new PointLight(document.Camera.Position, Colour.White, 0.7, document.File.Scene.Bounds.Diagonal);
            actions.ChangeScene(present => present with { Lights = present.Lights.Add(lamp) });
        }

        ui.Row(1, 1);
        if (ui.Button("Add a ball"))
        {
            AddAbove(static (above, size) => new BallLight(above, 0.05 * size, Colour.White, 0.7, 7.5 * size));
        }

        if (ui.Button("Add a quad"))
        {
            AddAbove(static (above, size) => new QuadLight(above, new(0, -1, 0), 0.3 * size, 0.2 * size, Colour.White, 0.7, 7.5 * size));
        }
    }

    /// <summary>Adds a light three quarters of the scene's size above its middle: a tenth of its range.</summary>
    private void AddAbove(Func<Vector, double, Light> create)
    {
        var bounds = actions.Document!.File.Scene.Bounds;
        var size = bounds.FiniteDiagonalOr(1);
        var above = bounds.Centre + (0.75 * size * Vector.J);
        actions.ChangeScene(present => present with { Lights = present.Lights.Add(create(above, size)) });
    }

    private void BuildLight(UserInterface ui, Light light, int index)
    {
        ui.Row(1);
        if (ui.Slider("intensity", light.Intensity, 0, 2, 0.01, isBounded: false) is { } intensity and >= 0 and <= 1e9)
        {
            actions.ChangeLight(index, present => present with { Intensity = intensity });
        }

        if (light is BallLight ball)
        {
            BuildSize(ui, ball, index, "radius", ball.Radius, static (light, size) => (BallLight)light with { Radius = size });
        }

        if (light is QuadLight quad)
        {
            BuildSize(ui, quad, index, "width", quad.Width, static (light, size) => (QuadLight)light with { Width = size });
            BuildSize(ui, quad, index, "height", quad.Height, static (light, size) => (QuadLight)light with { Height = size });
        }

        if (ui.Colour(light.Colour) is { } colour)
        {
            actions.ChangeLight(index, present => present with { Colour = PanelWidgets.Merge(present.Colour, light.Colour, colour) });
        }

        ui.Row(1);
        if (ui.Button("Remove the light"))
        {
            actions.EditLine(index, SceneEditor.RemoveLight);
            _light = -1;
        }
    }

    private void BuildSize(UserInterface ui, PointLight light, int index, string label, double size, Func<Light, double, Light> resize)
    {
        if (ui.Slider(label, ref size, 0, 2 * size, 0.01, isBounded: false) && size >= 1e-6 * light.Range && size <= 1e6 * light.Range)
        {
            actions.ChangeLight(index, present => resize(present, size));
        }
    }
}
