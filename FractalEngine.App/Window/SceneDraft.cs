using FractalEngine.Parsing.Assets;
using FractalEngine.Parsing.Scenes;
using FractalEngine.Parsing.Text;

namespace FractalEngine.App.Window;

/// <summary>What the window has changed of a scene since it was loaded or saved, as the text that would be saved.</summary>
internal sealed class SceneDraft
{
    private readonly ParsedScene? _layout;

    /// <summary>Begins with what a file says.</summary>
    /// <param name="file">The loaded file.</param>
    /// <param name="view">The view that the window shows of it, which need not be that of the file.</param>
    public SceneDraft(LoadedFile file, SceneView view)
    {
        _layout = file.ParsedScene;
        LayoutView = view;
        SavedView = view;
        SavedText = file.ParsedScene?.Source.Text ?? "";
    }

    /// <summary>The view that the lines of the loaded text stand for.</summary>
    public SceneView LayoutView { get; }

    /// <summary>The view that was loaded or saved last. What differs from it is a change.</summary>
    public SceneView SavedView { get; private set; }

    /// <summary>The text of the file when the window and the file last agreed: what a merge begins with.</summary>
    public string SavedText { get; private set; }

    /// <summary>Tells whether a view differs from the one that was loaded or saved. A model that is no scene has nothing to save.</summary>
    public bool IsChanged(SceneView view) => _layout is not null && view != SavedView;

    /// <summary>Returns the text of the scene with a view. Only what differs from the loaded view is written anew.</summary>
    public string Write(SceneView view) => Write(view, _layout!);

    /// <summary>Returns another text of the scene with a view, such as one that is edited and not loaded yet.</summary>
    /// <param name="view">The view to write.</param>
    /// <param name="text">A valid text of the scene, whose lines of the view are those that were loaded.</param>
    /// <exception cref="SourceException">The text is no scene.</exception>
    public string WriteInto(SceneView view, string text) =>
        Write(view, text == _layout!.Source.Text ? _layout : SceneParser.Parse(new(_layout.Source.FileName, text)));

    /// <summary>Returns a text of the scene with a view, or as it is where it is no scene.</summary>
    /// <inheritdoc cref="WriteInto"/>
    public string Carry(SceneView view, string text)
    {
        try
        {
            return WriteInto(view, text);
        }
        catch (SourceException)
        {
            // An undo may return to what never was a scene. It has no line for the view.
            return text;
        }
    }

    private string Write(SceneView view, ParsedScene layout)
    {
        var scene = layout.Scene;
        return SceneWriter.Write(
            scene with
            {
                Camera = view.Camera == LayoutView.Camera ? scene.Camera : view.Camera,
                Projection = view.Projection == LayoutView.Projection ? scene.Projection : view.Projection,
                OrthographicHeight =
                    view.OrthographicHeight.Equals(LayoutView.OrthographicHeight) ? scene.OrthographicHeight : view.OrthographicHeight,
            },
            layout);
    }

    /// <summary>Records that the file has a text that contains the view.</summary>
    public void MarkSaved(string text, SceneView view)
    {
        SavedText = text;
        SavedView = view;
    }

    /// <summary>Continues with the same changes after the file has been loaded again.</summary>
    /// <param name="file">The file as it is now.</param>
    /// <param name="layoutView">The view that its lines stand for.</param>
    /// <param name="view">The view that the window has shown of the file before.</param>
    public SceneDraft Rebase(LoadedFile file, SceneView layoutView, SceneView view)
    {
        var rebased = new SceneDraft(file, layoutView);
        if (IsChanged(view) && file.ParsedScene is { } parsed
            && SceneMerge.Merge(SavedText, Write(view), parsed.Source.Text).Conflicts.Length > 0)
        {
            // Both sides have changed the same line. The next save begins where they last agreed, and asks.
            rebased.SavedText = SavedText;
        }

        return rebased;
    }
}
