using FractalEngine.App.Window.State;
using FractalEngine.Core;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Scenes.Films;
using FractalEngine.Core.Scenes.Lights;
using FractalEngine.Parsing.Editing;
using FractalEngine.Parsing.Text;

namespace FractalEngine.App.Window.Actions;

/// <summary>Changes that menus, panels and handles make in the text of a scene.</summary>
internal static class SceneEdits
{
    private const double DroppedRestitution = 0.2;
    private const double DroppedFriction = 0.5;

    /// <summary>Changes the scene of the document, as a step that can be undone.</summary>
    /// <inheritdoc cref="EditScene"/>
    public static bool ChangeScene(this WindowActions actions, Func<Scene, Scene> change) =>
        actions.EditScene(text => SceneEditor.Change(text, change));

    /// <summary>Changes an object of the document's scene. Refused while the scene has other objects than were loaded.</summary>
    public static void ChangeObject(this WindowActions actions, int index, Func<SceneObject, SceneObject> change) =>
        actions.ChangeScene(scene =>
        {
            RequireLoaded(actions, scene);
            return scene with { Objects = scene.Objects.SetItem(index, change(scene.Objects[index])) };
        });

    /// <summary>Makes the selected object a body that has the shape of its mesh or fractal, and falls.</summary>
    /// <returns>False where no object is selected, or one that is a body already.</returns>
    public static bool TryDropSelected(this WindowActions actions)
    {
        if (HandleLines.SelectedObject(actions.Document!) is not (var index, { File: { } file } and not PhysicsObject, _))
        {
            return false;
        }

        try
        {
            _ = new MeshShape(actions.Document!.File.Scene.Objects[index].Model);
            actions.ChangeObject(index, present => new PhysicsObject(file, present.Placement, DroppedRestitution)
            {
                Name = present.Name, Colour = present.Colour, Gradient = present.Gradient, Friction = DroppedFriction,
                Shape = BodyShape.Mesh,
            });
        }
        catch (Exception exception) when (exception is FractalEngineException or ArgumentException)
        {
            actions.Show($"it can't fall: {exception.Message}");
        }

        return true;
    }

    /// <summary>Changes a light of the document's scene. Refused while the scene has other lights than were loaded.</summary>
    public static void ChangeLight(this WindowActions actions, int index, Func<Light, Light> change) =>
        actions.ChangeScene(scene =>
        {
            RequireLoaded(actions, scene);
            return scene with { Lights = scene.Lights.SetItem(index, change(scene.Lights[index])) };
        });

    /// <summary>Adds the present camera to the film of the document's scene, at the time that is shown.</summary>
    public static void AddKey(this WindowActions actions)
    {
        var document = actions.Document!;
        var key = new CameraKey(document.Film?.Time ?? 0, Document.WithoutNegativeZeros(document.Camera));
        if (actions.EditScene(text => SceneEditor.AddKey(text, key)))
        {
            actions.Show(FormattableString.Invariant($"a key at {key.Time:0.##} s: Ctrl+S saves the scene"));
        }
    }

    /// <summary>Changes the line of an object or a light. Refused while the scene has others than were loaded.</summary>
    public static void EditLine(this WindowActions actions, int index, Func<string, int, string> edit) =>
        actions.EditScene(text =>
        {
            RequireLoaded(actions, SceneEditor.Parse(text));
            return edit(text, index);
        });

    /// <summary>Throws where an edit has added or removed objects or lights, and was not loaded: indices mean others there.</summary>
    private static void RequireLoaded(WindowActions actions, Scene present)
    {
        var loaded = actions.Document!.File.Scene.Scene;
        if ((present.Objects.Length, present.Lights.Length) != (loaded.Objects.Length, loaded.Lights.Length))
        {
            throw new ArgumentException("the last change is not loaded yet: wait, or take it back with Ctrl+Z");
        }
    }

    /// <summary>Changes the text of the document's scene, as a step that can be undone.</summary>
    /// <returns>False where the change is refused, since it would leave no scene. The user is told why.</returns>
    public static bool EditScene(this WindowActions actions, Func<string, string> edit)
    {
        var document = actions.Document!;
        var path = document.File.Path;
        try
        {
            var text = edit(document.Edits.TextOf(path));
            SceneEditor.Parse(text);
            actions.Saver.Edit(path, text, actions.Panels.Ui.Interaction);
            return true;
        }
        catch (SourceException exception)
        {
            actions.ShowProblem((exception.Diagnostic with { File = Path.GetFileName(path) }).ToString());
        }
        catch (Exception exception) when (exception is FractalEngineException or ArgumentException)
        {
            actions.Show(exception.Message);
        }

        return false;
    }
}
