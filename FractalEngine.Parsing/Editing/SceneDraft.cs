using FractalEngine.Parsing.Assets;
using FractalEngine.Parsing.Sdo;
using FractalEngine.Parsing.Sdo.Merging;

namespace FractalEngine.Parsing.Editing;

/// <summary>What the window has changed of a scene since it was loaded or saved, as the text that would be saved.</summary>
/// <param name="File">The loaded file.</param>
/// <param name="LayoutView">The view that the lines of the loaded text stand for.</param>
public sealed record SceneDraft(LoadedFile File, SceneView LayoutView)
{
    /// <summary>The view that was loaded or saved last. What differs from it is a change.</summary>
    public SceneView SavedView { get; init; } = LayoutView;

    /// <summary>
    /// The text of the file, with what is edited in it, when the lines of the view in the window and the file last agreed: what a merge of
    /// these lines begins with.
    /// </summary>
    public string SavedText { get; init; } = File.ParsedScene?.Source.Text ?? "";

    /// <summary>Tells whether a view differs from the one that was loaded or saved. A model that is no scene has nothing to save.</summary>
    public bool IsChanged(SceneView view) => File.ParsedScene is not null && view != SavedView;

    /// <summary>Returns the saved text with a view. Only lines of the view can differ.</summary>
    /// <remarks>
    /// The loaded text may be older or newer than the saved one, while the file is being loaded again. So what is taken from it are only
    /// the lines in which the view and the saved one differ.
    /// </remarks>
    public string Write(SceneView view) => Carry(view, SavedText);

    /// <summary>Returns another text of the scene with a view, such as one that is edited and not saved yet.</summary>
    /// <param name="view">The view to write.</param>
    /// <param name="text">A text that began with the saved one.</param>
    /// <returns>Null where an editor has changed the same lines, so that the user must be asked.</returns>
    public string? TryWriteInto(SceneView view, string text)
    {
        var merged = SceneMerge.Merge(SavedText, Write(view), text);
        return merged.Conflicts.Length == 0 ? merged.Text : null;
    }

    /// <summary>Returns another text of the scene with a view, whatever its lines of the view are.</summary>
    /// <param name="view">The view to write.</param>
    /// <param name="text">Any text: what never was a scene has its lines of the view, too.</param>
    public string Carry(SceneView view, string text) =>
        view == SavedView ? text : SceneMerge.Merge(WriteLayout(SavedView), WriteLayout(view), text, MergePreference.Mine).Text;

    /// <summary>Takes over that the file has a text that contains a view.</summary>
    public SceneDraft Saved(string text, SceneView view) => this with { SavedText = text, SavedView = view };

    /// <summary>Continues with the same changes after the file has been loaded again.</summary>
    /// <param name="file">The file as it is now.</param>
    /// <param name="layoutView">The view that its lines stand for.</param>
    /// <param name="view">The view that the window has shown of the file before.</param>
    public SceneDraft Rebase(LoadedFile file, SceneView layoutView, SceneView view)
    {
        var rebased = new SceneDraft(file, layoutView);
        // Where both sides have changed the same line, the next save begins where they last agreed, and asks.
        return IsChanged(view) && file.ParsedScene is { } parsed && TryWriteInto(view, parsed.Source.Text) is null
            ? rebased with { SavedText = SavedText }
            : rebased;
    }

    private string WriteLayout(SceneView view)
    {
        var scene = File.ParsedScene!.Scene;
        return SceneWriter.Write(
            scene with
            {
                Camera = view.Camera == LayoutView.Camera ? scene.Camera : view.Camera,
                Projection = view.Projection == LayoutView.Projection ? scene.Projection : view.Projection,
                OrthographicHeight =
                    view.OrthographicHeight.Equals(LayoutView.OrthographicHeight) ? scene.OrthographicHeight : view.OrthographicHeight,
            },
            File.ParsedScene);
    }
}
