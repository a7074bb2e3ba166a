using System.Diagnostics;
using FractalEngine.Core;
using FractalEngine.Core.Threading;
using FractalEngine.Render.Views;

namespace FractalEngine.Render.Tracing;

/// <summary>
/// Traces one view at a time in the background, on all cores at low priority. Images are published while they converge. Another view ends
/// the trace of the last one within the time of a row of pixels.
/// </summary>
/// <remarks>All members belong to one thread, which <paramref name="published"/> may wake.</remarks>
/// <param name="sampleCount">Number of samples of each pixel, at least 1, after which the trace is done.</param>
/// <param name="settings">Crease angle, and background of scenes without one.</param>
/// <param name="published">Called on another thread when there is something new to show.</param>
public sealed class ProgressiveTrace(int sampleCount, RenderSettings settings, Action published) : IDisposable
{
    // The image is faded in over the frame between these numbers of samples, or earlier where fewer are asked for.
    private const int FirstShownSample = 4;
    private const int FullyShownSample = 16;

    // A view that is gone by then, as in a drag, is not worth the start.
    private static readonly TimeSpan StillTime = TimeSpan.FromSeconds(0.15);

    private static readonly TimeSpan PublishInterval = TimeSpan.FromSeconds(0.5);

    // Samples get at least so many times as long as images to publish.
    private const int SampleShare = 5;

    private readonly Lock _lock = new();
    private LowPriorityScheduler? _scheduler;
    private Task _task = Task.CompletedTask;
    private CancellationTokenSource? _cancellation;
    private TraceRequest? _request;
    private bool _hasUpdate;
    private bool _holdsScene;
    private bool _isDisposed;

    // Of the background: the last scene as it was prepared.
    private (TraceRequest Request, PathTracer Tracer)? _prepared;

    /// <summary>Whether there is nothing to trace, samples are being added, all were added, or the trace has failed.</summary>
    public TraceState State { get; private set; }

    /// <summary>Number of samples that each pixel had when the trace was published last.</summary>
    public int SampleCount { get; private set; }

    /// <summary>Number of samples that each pixel gets.</summary>
    public int MaxSampleCount => sampleCount;

    /// <summary>Whether images are published without their noise. False unless stated.</summary>
    public bool Denoises { get; init; }

    /// <summary>The latest image and its opacity; null before the first one.</summary>
    public ImageLayer? Layer { get; private set; }

    /// <summary>Why the view can't be traced; null unless the trace has failed.</summary>
    public string? Problem { get; private set; }

    /// <summary>True until the background has ended its work, which may be that for a view that is no longer shown.</summary>
    public bool IsBusy => !_task.IsCompleted;

    /// <summary>Starts to trace a view, unless it is the one that is traced already.</summary>
    /// <param name="request">The view; null for none.</param>
    /// <exception cref="ObjectDisposedException">There is a view, and the trace was disposed.</exception>
    public void Show(TraceRequest? request)
    {
        ObjectDisposedException.ThrowIf(_isDisposed && request is not null, this);
        lock (_lock)
        {
            if (request == _request)
            {
                return;
            }

            _cancellation?.Cancel();
            _cancellation = null;
            _request = request;
            SampleCount = 0;
            Layer = null;
            Problem = null;
            State = request is null ? TraceState.Idle : TraceState.Tracing;
            if (request is not null)
            {
                Start(request);
            }
        }
    }

    /// <summary>Ends the trace, and lets go of the scene that was prepared for it. Costs nothing where there is none.</summary>
    public void Release()
    {
        Show(null);
        if (_holdsScene)
        {
            _holdsScene = false;
            _task = _task.ContinueWith(_ => _prepared = null, TaskScheduler.Default);
        }
    }

    /// <summary>Returns whether anything was published since the last call.</summary>
    /// <remarks>Throws the exception of a trace that has failed unexpectedly.</remarks>
    public bool TakeUpdate()
    {
        if (_task.IsFaulted)
        {
            _task.GetAwaiter().GetResult();
        }

        return Interlocked.Exchange(ref _hasUpdate, false);
    }

    /// <summary>Ends the trace, without waiting for it. Harmless when repeated.</summary>
    public void Dispose()
    {
        _isDisposed = true;
        Release();
        if (_scheduler is { } scheduler)
        {
            _task.ContinueWith(_ => scheduler.Dispose(), TaskScheduler.Default);
            _scheduler = null;
        }
    }

    /// <summary>Returns how much of an image is shown over the frame, from 0 to 1.</summary>
    /// <param name="count">Number of samples that each pixel has.</param>
    /// <param name="maxCount">Number of samples that each pixel gets.</param>
    internal static double Opacity(int count, int maxCount)
    {
        var first = Math.Min(FirstShownSample, maxCount);
        var full = Math.Min(FullyShownSample, maxCount);
        return Math.Clamp((count - first + 1.0) / (full - first + 1), 0, 1);
    }

    private void Start(TraceRequest request)
    {
        var cancellation = new CancellationTokenSource();
        _cancellation = cancellation;
        _holdsScene = true;
        _scheduler ??= new();
        // After the last view, whose preparation is used further.
        _task = _task.ContinueWith(
            _ => Trace(request, cancellation.Token), CancellationToken.None, TaskContinuationOptions.None, _scheduler);
    }

    private void Trace(TraceRequest request, CancellationToken cancellation)
    {
        if (cancellation.WaitHandle.WaitOne(StillTime))
        {
            return;
        }

        try
        {
            var tracer = Prepare(request);
            var start = Stopwatch.GetTimestamp();
            var interval = PublishInterval;
            for (var count = 1; count <= sampleCount; count++)
            {
                tracer.AddSample(scheduler: TaskScheduler.Current, cancellation: cancellation);
                if (count == sampleCount || Stopwatch.GetElapsedTime(start) >= interval)
                {
                    start = Stopwatch.GetTimestamp();
                    var opacity = Opacity(count, sampleCount);
                    var layer = opacity > 0
                        ? new ImageLayer(tracer.Denoise(scheduler: TaskScheduler.Current, cancellation: cancellation), opacity)
                        : null;
                    Publish(request, count == sampleCount ? TraceState.Done : TraceState.Tracing, count, layer, null);
                    var cost = Stopwatch.GetElapsedTime(start);
                    interval = SampleShare * cost > PublishInterval ? SampleShare * cost : PublishInterval;
                    start = Stopwatch.GetTimestamp();
                }
            }
        }
        catch (OperationCanceledException)
        {
            // Another view is shown.
        }
        catch (FractalEngineException exception)
        {
            Publish(request, TraceState.Failed, 0, null, exception.Message);
        }
    }

    private PathTracer Prepare(TraceRequest request)
    {
        var (scene, view, width, height) = request;
        var tracer = _prepared is not { } prepared ? new PathTracer(scene, view, width, height, settings) { CanDenoise = Denoises }
            : prepared.Request.Scene == scene ? prepared.Tracer.WithView(view, width, height)
            : prepared.Tracer.WithScene(scene, view, width, height);
        _prepared = (request, tracer);
        return tracer;
    }

    private void Publish(TraceRequest request, TraceState state, int count, ImageLayer? layer, string? problem)
    {
        lock (_lock)
        {
            if (!ReferenceEquals(request, _request))
            {
                return;
            }

            State = state;
            SampleCount = count;
            Layer = layer;
            Problem = problem;
            _hasUpdate = true;
        }

        published();
    }
}
