using FractalEngine.App.Window.Actions;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Scenes.Lights;
using FractalEngine.Render.Ui;

namespace FractalEngine.App.Window.Widgets;

/// <summary>The sky of a scene, its exposure, tone and haze, in the scene's panel.</summary>
internal sealed class SkyFields(WindowActions actions)
{
    private static readonly Colour DefaultZenith = new(0.25, 0.45, 0.75);
    private static readonly Colour DefaultHorizon = new(0.75, 0.82, 0.90);

    private bool _isOpen;

    // The sky that was taken away last, and the scene that had it.
    private (string Path, Sky Sky)? _removed;

    public void Build(UserInterface ui, Scene scene)
    {
        if (!ui.Branch("Sky and haze", ref _isOpen))
        {
            return;
        }

        ui.Row(1);
        if (ui.CheckBox("sky", scene.Sky is not null))
        {
            var path = actions.Document!.File.Path;
            var added = _removed is var (owner, removed) && owner == path ? removed : new ColourSky(DefaultZenith, DefaultHorizon);
            _removed = scene.Sky is { } present ? (path, present) : _removed;
            actions.ChangeScene(present => present with { Sky = scene.Sky is null ? added : null });
        }

        ui.Tooltip("light from all around; a background hides the sky itself");
        switch (scene.Sky)
        {
            case ColourSky sky:
                BuildColour(ui, "zenith", sky.Zenith, static sky => sky.Zenith, (present, colour) => present with { Zenith = colour });
                BuildColour(ui, "horizon", sky.Horizon, static sky => sky.Horizon, (present, colour) => present with { Horizon = colour });
                break;
            case ImageSky sky:
                BuildImage(ui, sky);
                break;
        }

        ui.Row(1);
        if (ui.Slider("exposure", scene.Exposure, 0.1, 4, 0.05, isBounded: false) is { } exposure and >= 1e-9 and <= 1e9)
        {
            actions.ChangeScene(present => present with { Exposure = exposure });
        }

        ui.Tooltip("multiplies all light before it is shown");
        if (ui.CheckBox("filmic tone", scene.Tone == Tone.Filmic))
        {
            actions.ChangeScene(present => present with { Tone = scene.Tone == Tone.Filmic ? Tone.None : Tone.Filmic });
        }

        BuildFog(ui, scene);
    }

    private void BuildFog(UserInterface ui, Scene scene)
    {
        var size = actions.Document!.File.Scene.Bounds.FiniteDiagonalOr(1);
        ui.Row(1);
        if (ui.Slider("haze", scene.Fog?.Density ?? 0, 0, 3 / size, 0, isBounded: false) is { } density and >= 0 and < 1e6)
        {
            actions.ChangeScene(present => present with { Fog = density > 0 ? (present.Fog ?? new(0)) with { Density = density } : null });
        }

        ui.Tooltip("density of the haze: after d units, exp(-density * d) of the light is left");
        if (scene.Fog is null)
        {
            return;
        }

        if (ui.Slider("lit haze", scene.Fog.Albedo, 0, 1, 0.05) is { } albedo)
        {
            actions.ChangeScene(present => present with { Fog = present.Fog is { } fog ? fog with { Albedo = albedo } : null });
        }

        ui.Tooltip("share of the light of suns and lamps that the haze scatters: shafts of light");
    }

    private void BuildImage(UserInterface ui, ImageSky sky)
    {
        ui.Row(1);
        ui.Label(sky.File, isDim: true);
        var (turn, scale) = (sky.Turn, sky.Scale);
        var isChanged = ui.Slider("turn", ref turn, -180, 180, 1, isBounded: false);
        isChanged |= ui.Slider("scale", ref scale, 0.1, 4, 0.05, isBounded: false);
        if (isChanged && double.IsFinite(turn) && scale is > 0 and <= 1e9)
        {
            actions.ChangeScene(present => present with { Sky = sky with { Turn = turn, Scale = scale } });
        }
    }

    private void BuildColour(
        UserInterface ui, string name, Colour colour, Func<ColourSky, Colour> read,
        Func<ColourSky, Colour, ColourSky> change) => ui.Scope(name, () =>
    {
        ui.Row(1);
        ui.Label(name, isDim: true);
        if (ui.Colour(colour) is { } changed)
        {
            actions.ChangeScene(present => present.Sky is ColourSky sky ? present with
            {
                Sky = change(sky, PanelWidgets.Merge(read(sky), colour, changed)),
            } : present);
        }
    });
}
