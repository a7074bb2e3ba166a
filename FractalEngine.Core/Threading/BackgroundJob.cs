namespace FractalEngine.Core.Threading;

/// <summary>Runs work on another thread, and keeps its result or its exception.</summary>
/// <typeparam name="T">The result.</typeparam>
public sealed class BackgroundJob<T>
{
    /// <summary>Starts the work at once, on a thread of the pool.</summary>
    /// <param name="work">Computes the result.</param>
    /// <param name="ended">Called on another thread when the work has succeeded or failed.</param>
    public BackgroundJob(Func<CancellationToken, T> work, Action ended)
    {
        var cancellation = new CancellationTokenSource();
        Cancel = cancellation.Cancel;
        Result = Task.Run(() => work(cancellation.Token));
        Result.ContinueWith(_ => ended(), TaskScheduler.Default);
    }

    /// <summary>The result, or the exception of the work.</summary>
    public Task<T> Result { get; }

    /// <summary>Ends the work where it asks for that. Any thread may call this, and more than once.</summary>
    public Action Cancel { get; }
}
