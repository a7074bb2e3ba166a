using FractalEngine.Render;
using FractalEngine.Render.Windowing;

namespace FractalEngine.App.Window;

/// <summary>The keys that change how a scene is drawn.</summary>
internal static class SettingKeys
{
    /// <summary>
    /// The settings after a key was pressed, and a message where that is not plain to see; null for keys that change none.
    /// </summary>
    public static (RenderSettings Settings, string? Message)? Apply(RenderSettings settings, Key key) => key switch
    {
        Key.G => (settings with { Grid = !settings.Grid, Axes = !settings.Grid }, null),
        Key.X => (settings with { Wireframe = !settings.Wireframe }, null),
        Key.L when settings.Shading == Shading.PerVertex => (settings with { Shading = Shading.PerPixel }, "light at every pixel"),
        Key.L => (settings with { Shading = Shading.PerVertex }, "light at the vertices"),
        _ => null,
    };
}
