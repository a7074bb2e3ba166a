namespace FractalEngine.Render.Windowing.Events;

/// <summary>The user dropped a file on the window.</summary>
/// <param name="Path">Full path of the file.</param>
public sealed record FileDropped(string Path) : WindowEvent;
