using System.Collections.Immutable;
using FractalEngine.App.Window.Simulation;
using FractalEngine.App.Window.State;
using FractalEngine.App.Window.Tools;
using FractalEngine.Core.Maths;
using FractalEngine.Render.Views;
using FractalEngine.Render.Windowing.Events;
using FractalEngine.Render.Windowing.Keyboard;
using static FractalEngine.App.Window.Actions.ActionKinds;

namespace FractalEngine.App.Window.Actions;

/// <summary>All actions of the window. Key bindings, menus, the list of keys and the manual's table follow from it.</summary>
internal static class ActionTable
{
    /// <summary>Menus in the order in which they are shown.</summary>
    public static readonly ImmutableArray<string> Menus = ["File", "Edit", "View", "Go", "Physics", "Window"];

    /// <summary>All actions, in the order of menus and manual.</summary>
    public static readonly ImmutableArray<WindowAction> All =
    [
        new("new-fractal", "File", "New fractal…", "begin a fractal from a tree, a triangle or cubes, whose numbers are then turned")
        {
            Keys = [KeyChord.Control(Key.N)], Run = OverlayOf(static a => a.Files.NewFractal(() => a.Panels.Open("fractal"))),
        },
        new("open", "File", "Open…", "open a file") { Keys = [KeyChord.Control(Key.O)], Run = OverlayOf(static a => a.Files.AskForFile()) },
        new("approximate", "File", "Approximate…", "look for a fractal that makes what is shown, and open it beside that, or end that")
        {
            Run = OverlayOf(static a => a.Search.Toggle(() => a.Panels.Open("fractal"))), IsAvailable = HasDocument,
            IsOn = static a => a.Search.IsRunning,
        },
        new("save", "File", "Save", "save the changed numbers into their files, and the view into the scene's file")
        {
            Keys = [KeyChord.Control(Key.S)], Run = OverlayOf(static a => a.Saver.Save()), IsAvailable = HasDocument,
        },
        new("save-as", "File", "Save as…", "save as a new scene")
        {
            Keys = [KeyChord.ControlShift(Key.S)], Run = OverlayOf(static a => a.Saver.SaveAs()), IsAvailable = HasDocument,
        },
        new("export", "File", "Export…", "write what is on the screen for other programs, or end that")
        {
            Keys = [KeyChord.Control(Key.E)], Run = OverlayOf(static a => a.Export.Toggle()), IsAvailable = HasDocument,
            IsOn = static a => a.Export.IsRunning,
        },
        new("screenshot", "File", "Screenshot", "save a screenshot into `out/`")
        {
            Keys = [new(Key.F12)], Run = static a => a.SaveScreenshot(),
        },
        new("screenshot-panels", "File", "Screenshot of the window", "save a screenshot with menus and panels into `out/`")
        {
            Keys = [KeyChord.Control(Key.F12)], Run = static a => a.SaveWindowScreenshot(),
        },
        new("close", "File", "Close", "end measuring, else select nothing, else close the window; asks if something was not saved")
        {
            Keys = [new(Key.Escape)], Run = OverlayOf(static a => a.Files.Close()),
        },

        new("undo", "Edit", "Undo", "return to the view and the numbers before the last change")
        {
            Keys = [KeyChord.Control(Key.Z)], Run = static a => a.Undo(isRedo: false), IsAvailable = HasDocument,
        },
        new("redo", "Edit", "Redo", "make the change again that was undone")
        {
            Keys = [KeyChord.ControlShift(Key.Z)], Run = static a => a.Undo(isRedo: true), IsAvailable = HasDocument,
        },
        new("copy-camera", "Edit", "Copy camera",
            "copy the present camera as a line `c` of a scene, which `--camera` and `--path` take too")
        {
            Keys = [KeyChord.ControlShift(Key.C)], Run = static a => a.CopyCamera(), IsAvailable = HasDocument,
        },

        new("select-up", "Edit", "Up a level", "select the sub-fractal that the selected part belongs to, at last the object")
        {
            Keys = [new(Key.Backspace)], Run = static a => a.Show(a.Document!.Tool.Up()) | Redraw.Scene, IsAvailable = HasSelection,
        },
        new("copy-selection", "Edit", "Copy selection", "copy what is known about the selection, as lines of text")
        {
            Keys = [KeyChord.Control(Key.C)], Run = static a => a.CopySelection(), IsAvailable = HasSelection,
        },
        new("measure", "Edit", "Measure", "measure distances between clicks, or select by clicks again")
        {
            Keys = [new(Key.M)], Run = static a => a.Show(a.Document!.Tool.Measure.Toggle()) | Redraw.Scene, IsAvailable = HasDocument,
            IsOn = static a => a.Document?.Tool.Measure.IsActive == true,
        },

        new("film-key", "Edit", "Add a key", "write the present camera into the scene, as a key at the present time of its film")
        {
            IsAvailable = HasScene, Run = OverlayOf(static a => a.AddKey()),
        },

        Handles("handles-move", "Move", "move", Key.Digit2, HandleKind.Move),
        Handles("handles-turn", "Turn", "turn", Key.Digit4, HandleKind.Turn),
        Handles("handles-scale", "Scale", "scale", Key.Digit6, HandleKind.Scale),

        new("frame-scene", "View", "Frame the scene", "frame the scene: what is visible of it fills 80 % of the frame")
        {
            Keys = [new(Key.F)], MoveCamera = static (camera, aspect) => camera.FrameScene(aspect), IsAvailable = HasDocument,
        },
        Direction("view-front", "Front", Key.Digit1, Vector.K),
        Direction("view-right", "Right", Key.Digit3, -Vector.I),
        Direction("view-top", "Top", Key.Digit7, -Vector.J),
        new("projection", "View", "Orthographic", "perspective or orthographic; what is in focus keeps its size")
        {
            Keys = [new(Key.Digit5)], Flag = "--projection", MoveCamera = static (camera, _) => camera.ToggleProjection(),
            IsAvailable = HasDocument,
            IsOn = static a => a.Document?.FlyingCamera.Projection == Core.Scenes.Cameras.Projection.Orthographic,
        },
        new("reset-camera", "View", "File's camera", "return to the camera of the file")
        {
            Keys = [new(Key.Enter)], MoveCamera = static (camera, _) => camera.Reset(), IsAvailable = HasDocument,
        },
        Setting("grid", "Grid and axes", "grid and axes", Key.G, "--grid",
            static settings => settings.Grid, static (settings, on) => settings with { Grid = on, Axes = on }),
        Setting("wireframe", "Wireframe", "wireframe", Key.X, "--wireframe",
            static settings => settings.Wireframe, static (settings, on) => settings with { Wireframe = on }),
        Setting("pixel-light", "Pixel light", "light at the vertices or at every pixel", Key.L, "--shading",
            static settings => settings.Shading == Shading.PerPixel,
            static (settings, on) => settings with { Shading = on ? Shading.PerPixel : Shading.PerVertex },
            "lighting: per pixel", "lighting: per vertex"),
        Setting("shadows", "Shadows", "shadows of all lights, where lighting is computed at every pixel", null, "--no-shadows",
            static settings => settings.Shadows, static (settings, on) => settings with { Shadows = on }),
        Setting("ambient-occlusion", "Ambient occlusion",
            "less light within the holes of fractals, where lighting is computed at every pixel", null, "--no-ambient-occlusion",
            static settings => settings.AmbientOcclusion, static (settings, on) => settings with { AmbientOcclusion = on }),
        Setting("occlusion-culling", "Occlusion culling", "leave out what other parts hide; the image is the same", null, null,
            static settings => settings.Culling?.OcclusionCulling == true,
            static (settings, on) => settings.Culling is not { } culling ? settings
                : settings with { Culling = culling with { OcclusionCulling = on } }),
        new("normals", "View", "Normals", "normals of the selected instance's faces, or of all meshes where nothing is selected")
        {
            IsAvailable = HasDocument, IsOn = static a => a.Document?.Tool.ShowsNormals == true,
            Run = OfTool(static tool => tool.ShowsNormals = !tool.ShowsNormals),
        },
        new("level-boxes", "View", "Bounding boxes", "bounding boxes of whole objects; the view panel has those of the levels within")
        {
            IsAvailable = HasDocument, IsOn = static a => a.Document?.Tool.BoxLevel >= 0,
            Run = OfTool(static tool => tool.BoxLevel = tool.BoxLevel < 0 ? 0 : -1),
        },
        new("filmic-tone", "View", "Filmic tone", "show the scene in the tone of film, or its colours as they are computed")
        {
            IsAvailable = HasScene,
            Run = OverlayOf(static a => a.ChangeScene(static scene => scene with
            {
                Tone = scene.Tone == Core.Scenes.Tone.Filmic ? Core.Scenes.Tone.None : Core.Scenes.Tone.Filmic,
            })),
        },
        new("trace", "View", "Traced image", "a traced image while the view stands still, or drawn frames only")
        {
            Keys = [new(Key.Y)], Flag = "--trace", Run = static a => a.ToggleTracing(),
            IsOn = static a => a.Tracing.IsEnabled,
        },
        new("section", "View", "Section", "cut the scene open along a plane, which a knob drags, or show it whole")
        {
            Keys = [new(Key.K)], Flag = "--section", IsAvailable = HasDocument, IsOn = static a => a.Document?.Section.IsOn == true,
            Run = static a => a.Show(a.Document!.Section.Toggle(a.Document.File.Scene.Bounds, a.Document.Camera)) | Redraw.Scene,
        },
        new("flip-section", "View", "Flip", "cut away the other side of the section plane")
        {
            Keys = [KeyChord.Control(Key.K)], IsAvailable = HasSection,
            Run = static a => a.Show(a.Document!.Section.Flip()) | Redraw.Scene,
        },
        new("section-cap", "View", "Filled", "show solids filled where the section plane cuts them, or hollow")
        {
            Keys = [KeyChord.ControlShift(Key.K)], IsAvailable = HasSection,
            IsOn = static a => a.Document?.Section.Shown is { HasCap: true },
            Run = static a => a.Show(a.Document!.Section.ToggleCap()) | Redraw.Scene,
        },
        new("film-path", "View", "Film path", "the way of the film's camera as a line, with a mark at each key")
        {
            IsAvailable = HasFilm, IsOn = static a => a.Document?.Film?.ShowsPath == true,
            Run = static a =>
            {
                a.Document!.Film!.ShowsPath = !a.Document.Film.ShowsPath;
                return Redraw.Scene;
            },
        },
        new("papers-zoom", "View", "The paper's zoom",
            "the paper's zoom into a fractal (its matrix grows about the camera) instead of ours")
        {
            Keys = [new(Key.T)], Flag = "--trail", Run = static a => a.ToggleTrail(),
            IsAvailable = static a => a.Document?.Trail is not null, IsOn = static a => a.Document?.IsTrailEnabled == true,
        },

        Held("fly-forward", "fly forward", Key.W, Key.Up),
        Held("fly-left", "fly to the left", Key.A, Key.Left),
        Held("fly-back", "fly back", Key.S, Key.Down),
        Held("fly-right", "fly to the right", Key.D, Key.Right),
        Held("fly-up", "fly up", Key.E, Key.PageUp),
        Held("fly-down", "fly down", Key.Q, Key.PageDown),
        Gesture("speed", "Shift, Alt", "four times as fast, as slow"),
        Gesture("select", "click", "select the face, instance and object under the pointer"),
        Gesture("focus", "double click", "orbit around the point under the pointer"),
        Gesture("orbit", "left drag", "orbit around the point in focus"),
        Gesture("look", "right drag", "look around"),
        Gesture("pan", "middle drag, Shift + left drag", "pan"),
        Gesture("zoom", "wheel", "zoom to what is under the pointer"),
        new("walk", "Go", "Walk", "walk in the scene (W A S D, Space jumps, drag to look), or fly again")
        {
            Keys = [new(Key.P)], Run = Physics(static document => document.ToggleWalking()), IsAvailable = HasDocument,
            IsOn = static a => a.Document?.Physics.IsWalking == true,
        },

        new("pause", "Physics", "Pause", "pause and continue; with a film, play and pause that together with the bodies")
        {
            Keys = [new(Key.Space)], Run = Physics(static document => document.TogglePlaying()),
            IsAvailable = static a => a.Document?.Physics is { } physics && (!physics.IsWalking || physics.IsPaused),
            IsOn = static a => a.Document?.Physics.IsPaused == true,
        },
        new("film-stop", "Physics", "Stop the film", "return to the beginning of the film, and to the file's camera and numbers")
        {
            Run = static a => a.Show(a.Document!.StopFilm()) | Redraw.Scene, IsAvailable = HasFilm,
        },
        OfPhysics("step", "One step", "make one step", Key.N, static document => document.Physics.StepOnce()),
        new("drop-ball", "Physics", "Drop a ball",
            "let the selected object fall, as a body of its own shape; or drop a ball in the middle of the view, before the surface there")
        {
            Keys = [new(Key.B)], IsAvailable = HasDocument,
            Run = static a => a.TryDropSelected() ? Redraw.Scene : a.RunPhysics(static document => document.DropBall()),
        },
        new("throw-ball", "Physics", "Throw a ball", "throw a ball from the camera to the middle of the view")
        {
            Keys = [KeyChord.Control(Key.B)], Run = Physics(static document => document.ThrowBall()), IsAvailable = HasDocument,
        },
        OfPhysics("reset-bodies", "Reset bodies", "return the bodies to where the file has them", Key.R,
            static document => document.Physics.Reset()),
        OfPhysics("next-collider", "Next collider", "the next collider that fits the scene, for all bodies; the top line shows its cost",
            Key.C, static document => document.Physics.SwitchCollider()),
        new("shrinking", "Physics", "Shrinking", "let bodies shrink (paper §5.5): as the scene has it, or all; or let none")
        {
            Keys = [new(Key.J)], Run = Physics(static document => document.Physics.ToggleShrinking()), IsAvailable = HasDocument,
            IsOn = static a => a.Document?.Physics.IsShrinking == true,
        },
        new("closest-points", "Physics", "Closest points", "lines from bodies to their closest points, and the normals there")
        {
            Keys = [new(Key.V)], Run = Physics(static document => document.Physics.ToggleClosestPoints()), IsAvailable = HasDocument,
            IsOn = static a => a.Document?.Physics.ShowsClosestPoints == true,
        },

        Panel("view", "View panel", "projection, field of view, drawing, bookmarks", new(Key.F3)),
        Panel("physics", "Physics panel", "bodies, their collider, and its cost", new(Key.F5)),
        Panel("scene", "Scene panel", "objects with their places and colours, lights, background", new(Key.F2)),
        Panel("fractal", "Fractal panel", "the numbers of a fractal as sliders", new(Key.F4)),
        Panel("selection", "Selection panel", "what was clicked, and measured distances", new(Key.F6)),
        Panel("statistics", "Statistics", "cost of the last frame, and savings of each optimisation", new(Key.I)),
        new("keys", "Window", "Keys…", "list all actions with their keys; words search in it")
        {
            Keys = [new(Key.H)], Run = OverlayOf(static a => a.Panels.OpenKeys()),
        },
        new("menu-bar", "Window", "Hide menu and panels", "hide the menu and all panels, or show them again")
        {
            Keys = [new(Key.U)], Run = OverlayOf(static a => a.Panels.ToggleAll()), IsOn = static a => !a.Panels.IsShown,
        },
        new("full-screen", "Window", "Full screen", "fill the screen, or return to a window")
        {
            Keys = [new(Key.F11)], Run = OverlayOf(static a => a.IsFullScreen = !a.IsFullScreen), IsOn = static a => a.IsFullScreen,
        },
        new("larger-text", "Window", "Larger text", "larger menus and panels")
        {
            Keys = [KeyChord.Control(Key.Plus)], Run = static a => a.Show(a.Panels.ChangeScale(1)),
        },
        new("smaller-text", "Window", "Smaller text", "smaller menus and panels")
        {
            Keys = [KeyChord.Control(Key.Minus)], Run = static a => a.Show(a.Panels.ChangeScale(-1)),
        },
        new("light-colours", "Window", "Light colours", "dark text on light panels, or light on dark")
        {
            Keys = [KeyChord.Control(Key.L)], Run = OverlayOf(static a => a.Panels.ToggleTheme()),
            IsOn = static a => a.Panels.IsLight,
        },
    ];

    private static readonly Dictionary<KeyChord, WindowAction> ByChord =
        All.SelectMany(static action => action.Keys.Select(chord => (chord, action))).ToDictionary();

    /// <summary>Finds the action of a key that was pressed; null for keys without one.</summary>
    public static WindowAction? Find(KeyPressed pressed)
    {
        var chord = KeyChord.Of(pressed);
        return ByChord.GetValueOrDefault(chord)
            ?? ByChord.GetValueOrDefault(chord with { Modifiers = chord.Modifiers & ~KeyModifiers.Shift });
    }

    /// <summary>Returns the action with an id.</summary>
    /// <exception cref="InvalidOperationException">There is no such action.</exception>
    public static WindowAction Get(string id) => All.First(action => action.Id == id);
}
