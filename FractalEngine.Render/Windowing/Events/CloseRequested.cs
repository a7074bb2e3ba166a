namespace FractalEngine.Render.Windowing.Events;

/// <summary>The user asked to close the window. It stays open until it is disposed.</summary>
public sealed record CloseRequested : WindowEvent;
