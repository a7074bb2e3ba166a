using FractalEngine.Render;
using FractalEngine.Render.Windowing;

namespace FractalEngine.App.Window;

/// <summary>Maps keys to changes of the render settings.</summary>
internal static class SettingKeys
{
    /// <summary>Applies the change of a key to the settings.</summary>
    /// <returns>
    /// The changed settings, with a message where the change may be hard to see; null for keys that change no setting.
    /// </returns>
    public static (RenderSettings Settings, string? Message)? Apply(RenderSettings settings, Key key) => key switch
    {
        Key.G => (settings with { Grid = !settings.Grid, Axes = !settings.Grid }, null),
        Key.X => (settings with { Wireframe = !settings.Wireframe }, null),
        Key.L when settings.Shading == Shading.PerVertex => (settings with { Shading = Shading.PerPixel }, "lighting: per pixel"),
        Key.L => (settings with { Shading = Shading.PerVertex }, "lighting: per vertex"),
        _ => null,
    };
}
