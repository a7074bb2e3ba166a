using FractalEngine.App.Window.State;
using FractalEngine.App.Window.Tools;
using FractalEngine.Core.Maths;
using FractalEngine.Parsing.Text;
using FractalEngine.Render.Views;
using FractalEngine.Render.Windowing.Keyboard;

namespace FractalEngine.App.Window.Actions;

/// <summary>What actions of one kind have in common, and when they are available.</summary>
internal static class ActionKinds
{
    public static bool HasDocument(WindowActions actions) => actions.Document is not null;

    public static bool HasScene(WindowActions actions) => actions.Document?.File.Kind == FileKind.Scene;

    public static bool HasFilm(WindowActions actions) => actions.Document?.Film is not null;

    public static bool HasSelection(WindowActions actions) => actions.Document?.Tool.Selected is not null;

    /// <summary>Whether the scene is cut open.</summary>
    public static bool HasSection(WindowActions actions) => actions.Document?.Section.IsOn == true;

    public static WindowAction Handles(string id, string name, string verb, Key key, HandleKind kind) =>
        new(id, "Edit", name, $"{verb} the selected object of a scene by handles, where Ctrl snaps; again for no handles")
        {
            Keys = [new(key)],
            Run = a => a.Show(a.Document!.Tool.ToggleHandles(kind)) | Redraw.Scene,
            IsOn = a => a.Document?.Tool.Handles == kind,
            IsAvailable = HasDocument,
        };

    /// <summary>Looks along a direction of the world.</summary>
    public static WindowAction Direction(string id, string name, Key key, Vector direction) =>
        new(id, "View", name, $"view from the {name.ToLowerInvariant()}")
        {
            Keys = [new(key)], MoveCamera = (camera, aspect) => camera.LookAlong(direction, aspect), IsAvailable = HasDocument,
        };

    /// <summary>Moves while a key is held.</summary>
    public static WindowAction Held(string id, string help, params ReadOnlySpan<Key> keys) =>
        new(id, "Go", "", help) { Keys = [.. keys.ToArray().Select(static key => new KeyChord(key))] };

    public static WindowAction Panel(string panel, string name, string contents, KeyChord key) =>
        new(panel == "statistics" ? panel : $"panel-{panel}", "Window", name, $"show or hide the panel: {contents}")
        {
            Keys = [key],
            Run = OverlayOf(a => a.Panels.Toggle(panel)),
            IsOn = a => a.Panels.IsOpen(panel),
        };

    public static WindowAction Gesture(string id, string gesture, string help) => new(id, "Go", "", help) { Gesture = gesture };

    public static WindowAction Setting(
        string id, string name, string help, Key? key, string? flag, Func<RenderSettings, bool> isOn,
        Func<RenderSettings, bool, RenderSettings> set, string? onMessage = null, string? offMessage = null) => new(id, "View", name, help)
        {
            Keys = key is { } pressed ? [new(pressed)] : [],
            Flag = flag,
            IsOn = a => isOn(a.Settings),
            Run = a =>
            {
                var on = !isOn(a.Settings);
                a.Settings = set(a.Settings, on);
                return (on ? onMessage : offMessage) is { } message ? a.Show(message) | Redraw.Scene : Redraw.Scene;
            },
        };

    public static WindowAction OfPhysics(string id, string name, string help, Key key, Func<Document, string> command) =>
        new(id, "Physics", name, help) { Keys = [new(key)], Run = Physics(command), IsAvailable = HasDocument };

    public static Func<WindowActions, Redraw> Physics(Func<Document, string> command) => actions => actions.RunPhysics(command);

    /// <summary>Runs a command of the selection, and draws a frame.</summary>
    public static Func<WindowActions, Redraw> OfTool(Action<SelectionTool> command) => actions =>
    {
        command(actions.Document!.Tool);
        return Redraw.Scene;
    };

    /// <summary>Runs a command that changes no frame.</summary>
    public static Func<WindowActions, Redraw> OverlayOf(Action<WindowActions> command) => actions =>
    {
        command(actions);
        return Redraw.Overlay;
    };
}
