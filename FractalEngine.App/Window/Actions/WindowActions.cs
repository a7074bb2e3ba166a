using FractalEngine.App.Jobs;
using FractalEngine.App.Window.Drawing;
using FractalEngine.App.Window.Files;
using FractalEngine.App.Window.Input;
using FractalEngine.App.Window.Loading;
using FractalEngine.App.Window.State;
using FractalEngine.Core;
using FractalEngine.Core.Images;
using FractalEngine.Render.Views;
using FractalEngine.Render.Windowing;
using FractalEngine.Render.Windowing.Events;

namespace FractalEngine.App.Window.Actions;

/// <summary>Runs the actions of the <see cref="ActionTable"/> on the window and its document.</summary>
/// <param name="window">The window whose size screenshots have.</param>
/// <param name="renderer">The renderer of the window, for screenshots.</param>
/// <param name="overlay">The overlay of the window, which shows messages.</param>
/// <param name="tracing">Traces the view of the window.</param>
/// <param name="panels">The panels of the window.</param>
/// <param name="loader">Loads files, and owns the document.</param>
/// <param name="files">Opens files, and asks before changes are lost.</param>
/// <param name="saver">Edits and saves files.</param>
/// <param name="search">Looks for fractals.</param>
/// <param name="export">Writes files for other programs.</param>
/// <param name="settings">The initial render settings.</param>
/// <param name="clock">Tells the present time.</param>
/// <param name="requestDraw">Lets the window draw a new frame.</param>
internal sealed class WindowActions(
    RenderWindow window, WindowRenderer renderer, WindowOverlay overlay, WindowTracing tracing, PanelLayout panels,
    DocumentLoader loader, FileCommands files, DocumentSaver saver, WindowApproximation search, WindowExport export,
    RenderSettings settings, Func<TimeSpan> clock, Action requestDraw)
{
    private readonly Queue<WindowAction> _chosen = [];

    public RenderSettings Settings { get; set; } = settings;

    /// <summary>The document shown; null for none.</summary>
    public Document? Document => loader.Document;

    /// <summary>Opens files, and asks before changes are lost.</summary>
    public FileCommands Files => files;

    /// <summary>Edits and saves the files of the document, and asks where others have changed them.</summary>
    public DocumentSaver Saver => saver;

    /// <summary>Looks for a fractal that makes what is shown.</summary>
    public WindowApproximation Search => search;

    /// <summary>Writes what is shown for other programs.</summary>
    public WindowExport Export => export;

    /// <summary>All that runs in the background, with a panel of its own while it does.</summary>
    public IEnumerable<WindowJob> Jobs => [export, search];

    public PanelLayout Panels => panels;

    public WindowOverlay Overlay => overlay;

    public WindowTracing Tracing => tracing;

    /// <summary>Lets the window run an action that was chosen in a menu or a panel.</summary>
    public void Choose(WindowAction action) => _chosen.Enqueue(action);

    /// <summary>Returns the next action that was chosen in a menu or a panel; null for none.</summary>
    public WindowAction? TakeChosen() => _chosen.TryDequeue(out var action) ? action : null;

    /// <summary>Runs the command of a key. Keys of the camera are those of <see cref="CameraControls"/>, and ignored here.</summary>
    public Redraw Handle(KeyPressed pressed) =>
        ActionTable.Find(pressed) is { MoveCamera: null } action ? Run(action) : Redraw.None;

    public Redraw Run(WindowAction action)
    {
        if (!action.IsAvailable(this))
        {
            return Redraw.None;
        }

        if (action.MoveCamera is { } moveCamera)
        {
            Document!.MoveCamera(moveCamera, Document.Area.Aspect);
            return Redraw.Scene;
        }

        return action.Run?.Invoke(this) ?? Redraw.None;
    }

    /// <summary>Asks for a new frame, since a panel has changed what it shows.</summary>
    public void RequestDraw() => requestDraw();

    /// <summary>Shows a message for a few seconds.</summary>
    public Redraw Show(string message)
    {
        overlay.ShowMessage(message, clock());
        return Redraw.Overlay;
    }

    /// <summary>Shows an error for some time, and writes it to stderr.</summary>
    public void ShowProblem(string error) => overlay.ShowProblem(error, clock());

    /// <summary>Returns to the view before the last move, or makes it again.</summary>
    public Redraw Undo(bool isRedo)
    {
        var edits = Document!.Edits;
        var message = Document.Undo(isRedo);
        if (!edits.Equals(Document.Edits))
        {
            loader.State = loader.State.Reload();
        }

        return Show(message) | Redraw.Scene;
    }

    public bool IsFullScreen
    {
        get => window.IsFullScreen;
        set => window.IsFullScreen = value;
    }

    /// <summary>Ends measuring, or selects nothing.</summary>
    public Redraw ClearSelection()
    {
        var tool = Document!.Tool;
        if (tool.Measure.IsActive)
        {
            return Show(tool.Measure.Toggle()) | Redraw.Scene;
        }

        tool.Selected = null;
        return Show("nothing selected; Esc again closes the window") | Redraw.Scene;
    }

    /// <summary>Copies what is known about the selection.</summary>
    public Redraw CopySelection()
    {
        window.ClipboardText = Document!.Tool.Selected!.ToText();
        return Show("the selection is in the clipboard");
    }

    /// <summary>Copies the present camera as a line of a scene.</summary>
    public Redraw CopyCamera()
    {
        window.ClipboardText = CameraText.Format(Document.WithoutNegativeZeros(Document!.Camera));
        return Show("the camera is in the clipboard, as a line of a scene");
    }

    /// <summary>Saves what is shown without overlay as an image.</summary>
    public Redraw SaveScreenshot()
    {
        Save(() => tracing.OpaqueImage ?? renderer.Capture(Document!, Settings, window.Width, window.Height));
        return Redraw.Scene;
    }

    /// <summary>Saves what is shown, with menus and panels, as an image.</summary>
    public Redraw SaveWindowScreenshot()
    {
        Save(() => renderer.CaptureWindow(tracing.Layer, panels.Ui, overlay.Panels));
        return Redraw.Overlay;
    }

    private void Save(Func<PixelImage> capture)
    {
        string message;
        try
        {
            message = Document is null ? "no screenshot yet: nothing is shown" : Screenshots.Save(capture(), Document.File.Path);
        }
        catch (Exception exception) when (exception is FractalEngineException or InvalidOperationException or OutOfMemoryException)
        {
            // The window is larger than the driver can draw.
            message = $"error: no screenshot: {exception.Message}";
        }

        overlay.Report(message, clock());
    }

    /// <summary>Traces views that stand still from now on, or draws them only; later windows do the same.</summary>
    public Redraw ToggleTracing()
    {
        var message = tracing.Toggle();
        panels.IsTraced = tracing.IsEnabled;
        return Show(message) | Redraw.Scene;
    }

    /// <summary>Switches between the paper's zoom and that of the engine.</summary>
    public Redraw ToggleTrail()
    {
        var document = Document!;
        document.ToggleTrail();
        var length = document.Trail!.Length;
        return Redraw.Scene | Show(document.IsTrailEnabled
            ? FormattableString.Invariant($"the paper's zoom: the fractal grows about the camera, with {length} earlier levels")
            : "this engine's zoom: to any depth");
    }

    public Redraw RunPhysics(Func<Document, string> command)
    {
        var message = command(Document!);
        overlay.PhysicsStatus = Document!.Physics.StatusText;
        return Show(message) | Redraw.Scene;
    }
}
