namespace FractalEngine.Render.Tracing;

/// <summary>What a <see cref="ProgressiveTrace"/> does.</summary>
public enum TraceState
{
    /// <summary>There is no view to trace.</summary>
    Idle,

    /// <summary>Samples are added in the background.</summary>
    Tracing,

    /// <summary>Each pixel has all of its samples.</summary>
    Done,

    /// <summary>The view can't be traced.</summary>
    Failed,
}
