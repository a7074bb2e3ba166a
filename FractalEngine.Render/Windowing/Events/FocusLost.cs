namespace FractalEngine.Render.Windowing.Events;

/// <summary>The keyboard focus moved to another window. Keys that were held may never be reported as released.</summary>
public sealed record FocusLost : WindowEvent;
