using System.Globalization;
using FractalEngine.App.Window.Actions;
using FractalEngine.App.Window.State;
using FractalEngine.App.Window.Tools;
using FractalEngine.App.Window.Widgets;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Parsing.Editing;
using FractalEngine.Parsing.Text;
using FractalEngine.Render.Ui;
using FractalEngine.Render.Views;

namespace FractalEngine.App.Window.Panels;

/// <summary>The panel of a scene: its objects with their places and colours, its lights, and its background.</summary>
internal sealed class ScenePanel(WindowActions actions)
{
    private readonly LightList _lights = new(actions);
    private readonly PlacementFields _placement = new(actions);
    private readonly GradientFields _gradient = new(actions);
    private readonly SkyFields _sky = new(actions);
    private readonly CameraFields _camera = new(actions);
    private int _object = -1;
    private int _objectToSelect = -1;
    private bool _showsObjects = true;
    private string _addedFile = "";

    public void Build(UserInterface ui, Document document)
    {
        if (document.File.Kind != FileKind.Scene || document.File.ParsedScene is null)
        {
            ui.Paragraph("This is a single model. As a scene it can have more objects, lights and colours.");
            if (ui.Button("Save as a scene…"))
            {
                actions.Saver.SaveAs();
            }

            return;
        }

        var scene = document.File.Scene.Scene;
        if (_objectToSelect >= 0 && _objectToSelect < document.File.Scene.Objects.Length)
        {
            Select(document, _objectToSelect);
            _objectToSelect = -1;
        }

        if (document.Tool.Selected is { } selected && selected.ObjectIndex < scene.Objects.Length)
        {
            _object = selected.ObjectIndex;
        }

        BuildObjects(ui, document, scene);
        _lights.Build(ui, scene);
        _sky.Build(ui, scene);
        _camera.Build(ui, document);
        ui.Heading("Background");
        var shown = scene.Background ?? RenderSettings.DefaultBackground;
        if (ui.Colour(shown) is { } background)
        {
            actions.ChangeScene(present => present with
            {
                Background = PanelWidgets.Merge(present.Background ?? shown, shown, background),
            });
        }
    }

    /// <summary>Selects an object as a click would, so that the frame has its outline and its handles.</summary>
    private void Select(Document document, int index)
    {
        _object = index;
        document.Tool.Selected = Selection.OfObject(index, document.Physics.CurrentScene.Objects[index]);
        actions.RequestDraw();
    }

    private void BuildObjects(UserInterface ui, Document document, Scene scene)
    {
        var count = scene.Objects.Length;
        if (ui.Branch(string.Create(CultureInfo.InvariantCulture, $"Objects ({count:N0})"), ref _showsObjects))
        {
            ui.Row(1);
            ui.Rows(count, i =>
            {
                if (ui.Selectable(scene.Objects[i].DisplayName, i == _object, depth: 1))
                {
                    Select(document, i);
                }
            });
        }

        if (_object >= 0 && _object < count)
        {
            ui.Scope($"object {_object}", () => BuildObject(ui, scene.Objects[_object], _object));
        }

        var hidden = SceneEditor.FindHidden(document.File.ParsedScene!.Source.Text);
        if (hidden.Length > 0)
        {
            ui.Heading("Hidden: a click shows it");
            ui.Rows(hidden.Length, i =>
            {
                if (ui.Selectable(hidden[i], isSelected: false))
                {
                    actions.EditScene(text => SceneEditor.ShowObject(text, hidden[i]));
                }
            });
        }

        ui.Heading("Add an object");
        ui.Row(1, 7);
        ui.TextField("file (.obj, .fdo, …)", ref _addedFile, out var isCommitted);
        if ((ui.Button("Add") || isCommitted) && _addedFile.Trim() is { Length: > 0 } file)
        {
            var added = new SceneObject(file, Transformation.Identity);
            if (actions.ChangeScene(present => present with { Objects = present.Objects.Add(added) }))
            {
                _objectToSelect = count;
                _addedFile = "";
            }
        }
    }

    private void BuildObject(UserInterface ui, SceneObject declared, int index)
    {
        ui.Heading(declared.DisplayName);
        var name = declared.Name ?? "";
        ui.Row(8, 1);
        ui.Label("name", isDim: true);
        if (ui.TextField("no name", ref name))
        {
            actions.ChangeObject(index, present => present with { Name = name.Length > 0 ? name : null });
        }

        _placement.Build(ui, declared, index);
        ui.Row(1);
        ui.Label("colour", isDim: true);
        var shown = declared.Colour ?? Colour.White;
        if (ui.Colour(shown) is { } colour)
        {
            actions.ChangeObject(
                index, present => present with { Colour = PanelWidgets.Merge(present.Colour ?? shown, shown, colour) });
        }

        _gradient.Build(ui, declared, index);
        ui.Row(1, 1, 1);
        if (ui.Button("Hide"))
        {
            actions.EditLine(index, SceneEditor.HideObject);
            _object = -1;
            actions.Document!.Tool.Selected = null;
        }

        if (ui.Button("Duplicate"))
        {
            var offset = 0.25 * actions.Document!.File.Scene.Objects[index].Bounds.Size.X * Vector.I;
            var placement = declared.Placement with { Position = declared.Placement.Position + offset };
            actions.ChangeScene(present => present with { Objects = present.Objects.Add(declared.MovedTo(placement)) });
            _objectToSelect = actions.Document.File.Scene.Scene.Objects.Length;
        }

        if (ui.Button("Remove"))
        {
            actions.EditLine(index, SceneEditor.RemoveObject);
            _object = -1;
            actions.Document!.Tool.Selected = null;
        }
    }
}
