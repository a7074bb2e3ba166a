using FractalEngine.Core;
using FractalEngine.Parsing.Assets;
using FractalEngine.Render;
using FractalEngine.Render.Preparation;

namespace FractalEngine.App.Window;

/// <summary>Loads and prepares a file on another thread.</summary>
internal sealed class BackgroundLoad
{
    private readonly ThrottledProgress _progress = new();
    private readonly Task<(LoadedFile File, ScenePreparation Preparation)> _task;

    /// <summary>Starts at once.</summary>
    /// <param name="path">The file.</param>
    /// <param name="options">How to load it.</param>
    /// <param name="settings">How to prepare it.</param>
    /// <param name="aspect">Width divided by height of the window: what is in sight at first is prepared.</param>
    /// <param name="completed">Called on the other thread when it is done, or has failed.</param>
    public BackgroundLoad(string path, LoadOptions options, RenderSettings settings, double aspect, Action completed)
    {
        _task = Task.Run(() =>
        {
            var file = AssetLoader.Load(path, options, _progress);
            var preparation = new ScenePreparation(file.Scene, settings);
            if (file.Scene.Objects.Length == 1 || !settings.LazyLoading)
            {
                // Of one object, whatever the camera looks at, there is nothing else to show.
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

    /// <summary>Done, or failed.</summary>
    public bool IsCompleted => _task.IsCompleted;

    /// <summary>True once the result has been asked for.</summary>
    public bool IsResultTaken { get; private set; }

    /// <summary>What it is doing, and how far it has come.</summary>
    public (string Text, double Fraction) Progress => _progress.Latest;

    /// <summary>The result; null where the file can't be loaded.</summary>
    /// <param name="exitCode">Of a program that does nothing but load this file.</param>
    /// <param name="error">Why it can't be loaded; null where it can.</param>
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
