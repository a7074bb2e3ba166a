using FractalEngine.App.Shell.Reports;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Threading;
using FractalEngine.Render.Preparation;
using FractalEngine.Render.Views;

namespace FractalEngine.App.Window.State;

/// <summary>Prepares models in the background when their objects first become visible, and then the light within fractals.</summary>
/// <param name="preparation">The preparation of the scene.</param>
/// <param name="ended">Called on the other thread when models have been prepared, or could not be.</param>
internal sealed class FirstSightLoader(ScenePreparation preparation, Action ended) : IDisposable
{
    private readonly ThrottledProgress _progress = new();
    private volatile BackgroundJob<DrawableScene>? _job;
    private bool _isBaking;
    private bool _hasFailed;

    /// <summary>True from <see cref="Start"/> until <see cref="TakeScene"/> has returned the new scene.</summary>
    public bool IsRunning => _job is not null;

    /// <summary>The model being prepared, and the completed fraction from 0 to 1; null while nothing is prepared.</summary>
    public (string Text, double Fraction)? Progress => _job is null || _isBaking ? null : _progress.Latest;

    /// <summary>Starts to prepare the visible models that are still placeholders, unless a preparation is running.</summary>
    /// <param name="view">Camera and projection of the frame.</param>
    /// <param name="aspect">Width divided by height of the frame.</param>
    /// <param name="settings">Settings of the frame, which may need no light within fractals.</param>
    public void Start(View view, double aspect, RenderSettings settings)
    {
        if (_job is not null || _hasFailed)
        {
            return;
        }

        if (!preparation.IsComplete && preparation.HasUnpreparedVisibleModels(view, aspect))
        {
            _isBaking = false;
            Run(token => preparation.PrepareVisible(view, aspect, _progress, token));
        }
        else if (preparation.HasUnbakedSky(settings))
        {
            _isBaking = true;
            Run(preparation.BakeSky);
        }
    }

    private void Run(Action<CancellationToken> work) => _job = new(
        token =>
        {
            try
            {
                work(token);
            }
            catch (OperationCanceledException)
            {
                // What was prepared before stays.
            }

            return preparation.Scene;
        },
        ended);

    /// <summary>Returns the scene with newly prepared models, or null while there are none.</summary>
    /// <remarks>Throws the exception of a preparation that has failed. Nothing more is prepared then.</remarks>
    public DrawableScene? TakeScene()
    {
        if (_job is not { Result: { IsCompleted: true } result })
        {
            return null;
        }

        _job = null;
        _hasFailed = result.IsFaulted;
        return result.GetAwaiter().GetResult();
    }

    /// <summary>
    /// Ends the preparation, and returns the scene as far as it is prepared. Waits for the model in progress if that is still needed. May
    /// be called on any thread.
    /// </summary>
    /// <param name="isNeeded">Tells whether a model is needed further on.</param>
    public DrawableScene Stop(Func<Model, bool> isNeeded)
    {
        if (_job is { } job)
        {
            job.Cancel();
            if (preparation.Current is { } current && isNeeded(current))
            {
                job.Result.ContinueWith(static _ => { }, TaskScheduler.Default).Wait();
            }
        }

        return preparation.Scene;
    }

    /// <summary>Ends the preparation after the model in progress, whose result is dropped.</summary>
    public void Dispose() => _job?.Cancel();
}
