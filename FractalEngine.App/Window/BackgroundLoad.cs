using FractalEngine.Core;
using FractalEngine.Parsing.Assets;
using FractalEngine.Render;
using FractalEngine.Render.Preparation;

namespace FractalEngine.App.Window;

/// <summary>Loads a file and prepares its scene on another thread.</summary>
internal sealed class BackgroundLoad
{
    private readonly ThrottledProgress _progress = new();
    private readonly Task<(LoadedFile File, ScenePreparation Preparation)> _task;

    /// <summary>Starts to load a file.</summary>
    /// <param name="path">Path of the mesh, fractal or scene.</param>
    /// <param name="options">The load options of the file.</param>
    /// <param name="settings">The render settings to prepare the scene for.</param>
    /// <param name="aspect">Width divided by height of the window. Only models visible at first are prepared.</param>
    /// <param name="completed">Called on the other thread when the load has succeeded or failed.</param>
    public BackgroundLoad(string path, LoadOptions options, RenderSettings settings, double aspect, Action completed)
    {
        _task = Task.Run(() =>
        {
            var file = AssetLoader.Load(path, options, _progress);
            var preparation = new ScenePreparation(file.Scene, settings);
            if (file.Scene.Objects.Length == 1 || !settings.LazyLoading)
            {
                // A single object is prepared even if it is out of view, since there is nothing else to show.
                preparation.PrepareAll(_progress, CancellationToken.None);
            }
            else
            {
                preparation.PrepareVisible(View.Of(file.Scene, aspect), aspect, _progress);
            }

            return (file, preparation);
        });
        _task.ContinueWith(_ => completed(), TaskScheduler.Default);
    }

    /// <summary>True when the load has succeeded or failed.</summary>
    public bool IsCompleted => _task.IsCompleted;

    /// <summary>True once <see cref="TakeResult"/> has been called.</summary>
    public bool IsResultTaken { get; private set; }

    /// <summary>The file being loaded, and the completed fraction from 0 to 1.</summary>
    public (string Text, double Fraction) Progress => _progress.Latest;

    /// <summary>Waits for the load and returns its result; null if the file can't be loaded.</summary>
    /// <param name="exitCode">The exit code of a program that only loads this file.</param>
    /// <param name="error">The reason why the file can't be loaded; null if it can.</param>
    public (LoadedFile File, ScenePreparation Preparation)? TakeResult(out int exitCode, out string? error)
    {
        IsResultTaken = true;
        exitCode = ExitCode.Done;
        error = null;
        try
        {
            return _task.GetAwaiter().GetResult();
        }
        catch (FractalEngineException exception)
        {
            var failure = Failure.Of(exception);
            exitCode = failure.ExitCode;
            error = failure.Text;
            return null;
        }
    }
}
