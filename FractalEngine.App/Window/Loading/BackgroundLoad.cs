using FractalEngine.App.Shell;
using FractalEngine.App.Shell.Reports;
using FractalEngine.App.Window.State;
using FractalEngine.Core;
using FractalEngine.Core.Threading;
using FractalEngine.Parsing.Assets;
using FractalEngine.Render.Preparation;
using FractalEngine.Render.Tracing;
using FractalEngine.Render.Views;

namespace FractalEngine.App.Window.Loading;

/// <summary>Loads a file and prepares its scene on another thread.</summary>
internal sealed class BackgroundLoad
{
    private readonly ThrottledProgress _progress = new();
    private readonly BackgroundJob<(LoadedFile File, ScenePreparation Preparation)> _job;

    /// <summary>Starts to load a file and all that it refers to, and to prepare it for drawing.</summary>
    /// <param name="request">The file.</param>
    /// <param name="options">What overrides the files.</param>
    /// <param name="settings">The render settings to prepare the scene for.</param>
    /// <param name="aspect">Width divided by height of the window. Only models visible at first are prepared.</param>
    /// <param name="size">Size of the window in pixels.</param>
    /// <param name="cache">What was read before. No other load may use it meanwhile.</param>
    /// <param name="previous">The document whose models are used further where their files are unchanged; null for none.</param>
    /// <param name="ended">Called on the other thread when the load has succeeded or failed.</param>
    public BackgroundLoad(
        LoadRequest request, LoadOptions options, RenderSettings settings, double aspect, (int Width, int Height) size, AssetCache cache,
        Document? previous, Action ended)
    {
        Request = request;
        Cache = cache;
        // The camera may be elsewhere by the end of the load. What it sees then is prepared at first sight.
        var view = previous?.LatestView;
        _job = new(
            cancellation =>
            {
                var file = AssetLoader.Load(request.Path, options with { EditedTexts = request.Edits.Texts }, _progress, cache);
                var models = file.Scene.Models.ToHashSet();
                var lit = ExposureMeter.Expose(file.Scene, View.Of(file.Scene, aspect), size.Width, size.Height, settings);
                var preparation = new ScenePreparation(lit, settings, previous?.FirstSightLoader.Stop(models.Contains));
                if (file.Scene.Objects.Length == 1 || !settings.LazyLoading)
                {
                    // A single object is prepared even if it is out of view, since there is nothing else to show.
                    preparation.PrepareAll(_progress, cancellation);
                }
                else
                {
                    preparation.PrepareVisible(view ?? View.Of(file.Scene, aspect), aspect, _progress, cancellation);
                }

                return (file, preparation);
            },
            ended);
    }

    public LoadRequest Request { get; }

    /// <summary>What was read before, and by this load.</summary>
    public AssetCache Cache { get; }

    /// <summary>True when the load has succeeded or failed.</summary>
    public bool IsCompleted => _job.Result.IsCompleted;

    /// <summary>The file being loaded, and the completed fraction from 0 to 1.</summary>
    public (string Text, double Fraction) Progress => _progress.Latest;

    /// <summary>Waits for the load and returns its result; null if the file can't be loaded.</summary>
    /// <param name="failure">The reason why the file can't be loaded; null if it can.</param>
    public (LoadedFile File, ScenePreparation Preparation)? TakeResult(out Failure? failure)
    {
        failure = null;
        try
        {
            return _job.Result.GetAwaiter().GetResult();
        }
        catch (Exception exception) when (exception is FractalEngineException or OutOfMemoryException)
        {
            failure = Failure.Of(exception);
            return null;
        }
    }
}
