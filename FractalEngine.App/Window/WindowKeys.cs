using FractalEngine.Render;
using FractalEngine.Render.Windowing;

namespace FractalEngine.App.Window;

/// <summary>Runs the commands of keys that do not move the camera: overlays, files, render settings and physics.</summary>
/// <param name="window">The window whose size screenshots have.</param>
/// <param name="renderer">The renderer of the window, for screenshots.</param>
/// <param name="overlay">The overlay of the window, which shows messages.</param>
/// <param name="tracing">Traces the view of the window.</param>
/// <param name="settings">The initial render settings.</param>
internal sealed class WindowKeys(
    RenderWindow window, WindowRenderer renderer, WindowOverlay overlay, WindowTracing tracing, RenderSettings settings)
{
    /// <summary>The present render settings.</summary>
    public RenderSettings Settings { get; private set; } = settings;

    /// <summary>Runs the command of a key; keys without a command are ignored.</summary>
    /// <param name="pressed">The key that was pressed.</param>
    /// <param name="document">The document shown, or null.</param>
    /// <param name="files">Saves and opens files.</param>
    /// <param name="now">The present time.</param>
    public Redraw Handle(KeyPressed pressed, Document? document, FileCommands files, TimeSpan now)
    {
        if (pressed.Modifiers.HasFlag(KeyModifiers.Control))
        {
            return HandleControl(pressed, document, files, now);
        }

        switch (pressed.Key)
        {
            case Key.H:
                overlay.ShowsKeys = !overlay.ShowsKeys;
                return Redraw.Overlay;
            case Key.I:
                overlay.ShowsStatistics = !overlay.ShowsStatistics;
                return Redraw.Overlay;
            case Key.Y:
                overlay.ShowMessage(tracing.Toggle(), now);
                return Redraw.Scene;
            default:
                var redraw = document is null ? Redraw.None : HandleForDocument(pressed, document, now);
                return redraw == Redraw.None ? ApplySettings(pressed.Key, now) : redraw;
        }
    }

    private Redraw HandleControl(KeyPressed pressed, Document? document, FileCommands files, TimeSpan now)
    {
        var isShiftHeld = pressed.Modifiers.HasFlag(KeyModifiers.Shift);
        switch (pressed.Key)
        {
            case Key.O:
                files.AskForFile();
                return Redraw.Overlay;
            case Key.S when isShiftHeld:
                files.SaveAs();
                return Redraw.Overlay;
            case Key.S:
                files.Save();
                return Redraw.Overlay;
            case Key.Z when document is not null:
                overlay.ShowMessage(document.Undo(isRedo: isShiftHeld), now);
                return Redraw.Scene;
            case Key.C when isShiftHeld && document is not null:
                window.ClipboardText = CameraText.Format(document.GetCurrentScene().Camera!);
                overlay.ShowMessage("the camera is in the clipboard, as a line of a scene", now);
                return Redraw.Overlay;
            default:
                return Redraw.None;
        }
    }

    private Redraw HandleForDocument(KeyPressed pressed, Document document, TimeSpan now)
    {
        switch (pressed.Key)
        {
            case Key.T when document.Trail is { } trail:
                document.ToggleTrail();
                overlay.ShowMessage(ZoomMessage(document.IsTrailEnabled, trail.Length), now);
                return Redraw.Scene;
            case Key.F12:
                var image = tracing.OpaqueImage ?? renderer.Capture(document, Settings, window.Width, window.Height);
                overlay.Report(Screenshots.Save(image, document.File.Path), now);
                return Redraw.Scene;
        }

        if (PhysicsKeys.Apply(document, pressed.Key) is not { } message)
        {
            return Redraw.None;
        }

        overlay.PhysicsStatus = document.Physics.StatusText;
        overlay.ShowMessage(message, now);
        return Redraw.Scene;
    }

    private static string ZoomMessage(bool isPapers, int trailLength) => isPapers
        ? FormattableString.Invariant($"the paper's zoom: the fractal grows about the camera, with {trailLength} earlier levels")
        : "this engine's zoom: to any depth";

    private Redraw ApplySettings(Key key, TimeSpan now)
    {
        if (SettingKeys.Apply(Settings, key) is not var (changedSettings, message))
        {
            return Redraw.None;
        }

        Settings = changedSettings;
        if (message is not null)
        {
            overlay.ShowMessage(message, now);
        }

        return Redraw.Scene;
    }
}
