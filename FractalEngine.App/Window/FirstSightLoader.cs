using FractalEngine.Render;
using FractalEngine.Render.Preparation;

namespace FractalEngine.App.Window;

/// <summary>Prepares models in the background when their objects come in sight.</summary>
/// <param name="preparation">Of the scene.</param>
/// <param name="completed">Called on the other thread when some are prepared.</param>
internal sealed class FirstSightLoader(ScenePreparation preparation, Action completed)
{
    private readonly ThrottledProgress _progress = new();
    private Task? _task;

    /// <summary>True from <see cref="Start"/> until <see cref="TakeScene"/> has returned what was prepared.</summary>
    public bool IsRunning => _task is not null;

    /// <summary>What is being prepared, and how far that has come; null when nothing is.</summary>
    public (string Text, double Fraction)? Progress => _task is null ? null : _progress.Latest;

    /// <summary>Begins to prepare what is in sight and is not prepared yet, unless that is going on.</summary>
    /// <param name="view">Camera and projection.</param>
    /// <param name="aspect">Width divided by height of the picture.</param>
    public void Start(View view, double aspect)
    {
        if (_task is null && !preparation.IsComplete && preparation.HasUnpreparedVisibleModels(view, aspect))
        {
            _task = Task.Run(() =>
            {
                preparation.PrepareVisible(view, aspect, _progress);
                completed();
            });
        }
    }

    /// <summary>The scene with what was prepared since; null while nothing is new. An error of the preparation comes up here.</summary>
    public DrawableScene? TakeScene()
    {
        if (_task is not { IsCompleted: true } task)
        {
            return null;
        }

        _task = null;
        task.GetAwaiter().GetResult();
        return preparation.Scene;
    }

    /// <summary>Waits until nothing runs any more.</summary>
    public void Wait()
    {
        _task?.GetAwaiter().GetResult();
        _task = null;
    }
}
