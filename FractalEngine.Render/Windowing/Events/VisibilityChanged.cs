namespace FractalEngine.Render.Windowing.Events;

/// <summary>The window was hidden or minimised, or became visible again.</summary>
/// <param name="IsVisible">Whether the window is visible now.</param>
public sealed record VisibilityChanged(bool IsVisible) : WindowEvent;
