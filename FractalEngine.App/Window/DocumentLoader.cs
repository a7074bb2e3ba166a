using FractalEngine.Parsing.Assets;
using FractalEngine.Render;
using FractalEngine.Render.Preparation;
using FractalEngine.Render.Windowing;

namespace FractalEngine.App.Window;

/// <summary>
/// Owns the document of a window, and replaces it when another file has been loaded in the background. Progress and errors are shown in
/// the overlay.
/// </summary>
/// <param name="window">The window that shows the document.</param>
/// <param name="overlay">The overlay of the window.</param>
/// <param name="options">The options of the window.</param>
internal sealed class DocumentLoader(RenderWindow window, WindowOverlay overlay, WindowOptions options) : IDisposable
{
    private BackgroundLoad? _load;

    /// <summary>The document shown; null until the first file is loaded.</summary>
    public Document? Document { get; private set; }

    /// <summary>The exit code of the last load.</summary>
    public int ExitCode { get; private set; }

    /// <summary>True while a file is being loaded.</summary>
    public bool IsLoading => _load is { IsResultTaken: false };

    /// <summary>True while anything is loaded or prepared in the background, so that progress must be shown.</summary>
    public bool IsBusy => IsLoading || Document?.FirstSightLoader.IsRunning == true;

    /// <summary>Starts to load a file, unless another one is being loaded.</summary>
    /// <param name="path">Path of the mesh, fractal or scene.</param>
    /// <param name="settings">The present render settings.</param>
    public void Open(string path, RenderSettings settings)
    {
        if (IsLoading)
        {
            return;
        }

        window.Title = $"{Path.GetFileName(path)} - FractalEngine";
        _load = new(path, options.Load, settings, window.Aspect, window.Wake);
    }

    /// <summary>Takes over the results that are ready. Must be called on the window's thread.</summary>
    public Redraw Poll() => PollLoad() | PollFirstSight();

    /// <inheritdoc/>
    public void Dispose() => Document?.Dispose();

    private Redraw PollLoad()
    {
        if (_load is not { IsResultTaken: false } load)
        {
            return Redraw.None;
        }

        if (!load.IsCompleted)
        {
            overlay.Progress = load.Progress;
            return Redraw.Overlay;
        }

        overlay.Progress = null;
        var loaded = load.TakeResult(out var exitCode, out var error);
        ExitCode = exitCode;
        overlay.Error = error;
        if (loaded is not var (file, preparation))
        {
            Console.Error.WriteLine(error);
            return Redraw.Overlay;
        }

        Show(file, preparation);
        return Redraw.Scene;
    }

    private void Show(LoadedFile file, ScenePreparation preparation)
    {
        Document?.Dispose();
        Document = null;
        Document = new(window, file, preparation, options);
        foreach (var message in file.Warnings.Select(static warning => warning.ToString()).Concat(preparation.Scene.Notices))
        {
            Console.Error.WriteLine(message);
        }

        overlay.DescribeFile(file, preparation.Scene);
    }

    private Redraw PollFirstSight()
    {
        if (Document is not { FirstSightLoader.IsRunning: true } document)
        {
            return Redraw.None;
        }

        var scene = document.FirstSightLoader.TakeScene();
        overlay.Progress = document.FirstSightLoader.Progress;
        if (scene is null)
        {
            return Redraw.Overlay;
        }

        foreach (var notice in scene.Notices.Skip(document.Renderer.Scene.Notices.Length))
        {
            Console.Error.WriteLine(notice);
        }

        document.Renderer.Update(scene);
        overlay.DescribeFile(document.File, scene);
        return Redraw.Scene;
    }
}
