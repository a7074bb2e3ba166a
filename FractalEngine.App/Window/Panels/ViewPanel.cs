using FractalEngine.App.Window.Actions;
using FractalEngine.App.Window.State;
using FractalEngine.App.Window.Widgets;
using FractalEngine.Render.Cameras;
using FractalEngine.Render.Ui;

namespace FractalEngine.App.Window.Panels;

/// <summary>The panel of the camera, and of how the scene is drawn.</summary>
internal sealed class ViewPanel(WindowActions actions)
{
    private readonly List<(string Name, CameraState State)> _bookmarks = [];
    private readonly SectionFields _section = new(actions);
    private readonly ClipFields _clip = new(actions);

    public void Build(UserInterface ui)
    {
        ui.Actions(actions, 3, "view-front", "view-right", "view-top");
        ui.Actions(actions, 2, "frame-scene", "reset-camera");
        ui.Actions(actions, 1, "projection");
        if (actions.Document is { } document)
        {
            BuildCamera(ui, document);
            _clip.Build(ui, document);
        }

        ui.Heading("Drawing");
        ui.Actions(actions, 2, "wireframe", "grid", "pixel-light", "trace");
        BuildDetail(ui);
        if (actions.Document is { } shown)
        {
            ui.Row(1);
            if (ui.Slider("level boxes", shown.Tool.BoxLevel, -1, 8, 1) is { } level)
            {
                shown.Tool.BoxLevel = (int)level;
                actions.RequestDraw();
            }

            ui.Tooltip("bounding boxes of the sub-fractals at a level; 0 for whole objects, -1 for none");
            ui.Actions(actions, 1, "normals");
            _section.Build(ui, shown);
            BuildBookmarks(ui, shown);
        }
    }

    private void BuildCamera(UserInterface ui, Document document)
    {
        ui.Row(1);
        if (ui.Slider("field of view", document.FlyingCamera.Camera.FieldOfView, 10, 120, 0.5) is { } fieldOfView and > 0 and < 180)
        {
            document.MoveCamera((camera, _) => camera.SetFieldOfView(fieldOfView), 1, ui.Interaction);
            actions.RequestDraw();
        }

        ui.Tooltip("full vertical angle of view in degrees");
        var (aperture, focus) = (document.FlyingCamera.Camera.Aperture, document.FlyingCamera.Camera.FocusDepth);
        var size = document.File.Scene.Bounds.FiniteDiagonalOr(1);
        var isMoved = ui.Slider("aperture", ref aperture, 0, 0.1 * size, 0.0005 * size);
        ui.Tooltip("diameter of the lens in scene units; 0 shows everything sharp");
        isMoved |= ui.Slider("focus", ref focus, 0.001 * size, 3 * size, 0.001 * size);
        ui.Tooltip("depth of what is sharp; Ctrl+click in the scene focuses on a point");
        if (isMoved && aperture >= 0 && focus > 0 && double.IsFinite(aperture + focus))
        {
            document.MoveCamera((camera, _) => camera.SetLens(aperture, focus), 1, ui.Interaction);
            actions.RequestDraw();
        }
    }

    private void BuildDetail(UserInterface ui)
    {
        ui.Row(1);
        var culling = actions.Settings.Culling;
        if (ui.Slider("detail", culling?.MinProjectedSize ?? 0, 0.5, 20, 0.1) is { } detail && culling is not null)
        {
            actions.Settings = actions.Settings with { Culling = culling with { MinProjectedSize = Math.Max(0.1, detail) } };
            actions.RequestDraw();
        }

        ui.Tooltip("pixels below which a sub-fractal is drawn as one instance of its base mesh (--detail)");
        ui.Actions(actions, 1, "occlusion-culling", "shadows", "ambient-occlusion");
    }

    private void BuildBookmarks(UserInterface ui, Document document)
    {
        ui.Heading("Bookmarks");
        if (ui.Button("Remember this view"))
        {
            _bookmarks.Add(($"view {_bookmarks.Count + 1}", document.FlyingCamera.State));
        }

        for (var i = 0; i < _bookmarks.Count; i++)
        {
            ui.Row(1, 3);
            var (name, state) = _bookmarks[i];
            if (ui.Selectable(name, isSelected: document.FlyingCamera.State.Equals(state)))
            {
                document.MoveCamera((camera, _) => camera.Restore(state), 1);
                actions.RequestDraw();
            }

            if (ui.Button($"×{new string(' ', i)}"))
            {
                _bookmarks.RemoveAt(i);
                break;
            }
        }
    }
}
