using FractalEngine.App.Shell.Reports;
using FractalEngine.Core.Scenes;
using FractalEngine.Render.Preparation;
using FractalEngine.Render.Views;

namespace FractalEngine.App.Window.State;

/// <summary>Prepares models in the background when their objects first become visible, and then the light within fractals.</summary>
/// <param name="preparation">The preparation of the scene.</param>
/// <param name="completed">Called on the other thread when models have been prepared.</param>
internal sealed class FirstSightLoader(ScenePreparation preparation, Action completed) : IDisposable
{
    private readonly ThrottledProgress _progress = new();
    private readonly Lock _lock = new();
    private CancellationTokenSource _cancellation = new();
    private volatile Task? _task;
    private bool _isDisposed;
    private bool _isBaking;
    private bool _hasFailed;

    /// <summary>True from <see cref="Start"/> until <see cref="TakeScene"/> has returned the new scene.</summary>
    public bool IsRunning => _task is not null;

    /// <summary>The model being prepared, and the completed fraction from 0 to 1; null while nothing is prepared.</summary>
    public (string Text, double Fraction)? Progress => _task is null || _isBaking ? null : _progress.Latest;

    /// <summary>Starts to prepare the visible models that are still placeholders, unless a preparation is running.</summary>
    /// <param name="view">Camera and projection of the frame.</param>
    /// <param name="aspect">Width divided by height of the frame.</param>
    /// <param name="settings">Settings of the frame, which may need no light within fractals.</param>
    public void Start(View view, double aspect, RenderSettings settings)
    {
        if (_task is not null || _hasFailed)
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

    private void Run(Action<CancellationToken> work)
    {
        CancellationToken token;
        lock (_lock)
        {
            _cancellation.Dispose();
            _cancellation = new();
            token = _cancellation.Token;
        }

        _task = Task.Run(() =>
        {
            try
            {
                work(token);
            }
            catch (OperationCanceledException)
            {
                // What was prepared before stays.
            }

            completed();
        });
    }

    /// <summary>Returns the scene with newly prepared models, or null while there are none.</summary>
    /// <remarks>Throws the exception of a preparation that has failed. Nothing more is prepared then.</remarks>
    public DrawableScene? TakeScene()
    {
        if (_task is not { IsCompleted: true } task)
        {
            return null;
        }

        _task = null;
        _hasFailed = task.IsFaulted;
        task.GetAwaiter().GetResult();
        return preparation.Scene;
    }

    /// <summary>
    /// Ends the preparation, and returns the scene as far as it is prepared. Waits for the model in progress if that is still needed. May
    /// be called on any thread.
    /// </summary>
    /// <param name="isNeeded">Tells whether a model is needed further on.</param>
    public DrawableScene Stop(Func<Model, bool> isNeeded)
    {
        lock (_lock)
        {
            if (!_isDisposed)
            {
                _cancellation.Cancel();
            }
        }

        if (_task is { } task && preparation.Current is { } current && isNeeded(current))
        {
            task.ContinueWith(static _ => { }, TaskScheduler.Default).Wait();
        }

        return preparation.Scene;
    }

    /// <summary>Ends the preparation after the model in progress, whose result is dropped.</summary>
    public void Dispose()
    {
        lock (_lock)
        {
            if (!_isDisposed)
            {
                _isDisposed = true;
                _cancellation.Cancel();
                _cancellation.Dispose();
            }
        }
    }
}
