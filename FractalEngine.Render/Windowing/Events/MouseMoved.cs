namespace FractalEngine.Render.Windowing.Events;

/// <summary>The mouse moved within the window.</summary>
/// <param name="X">Framebuffer pixels from the left edge.</param>
/// <param name="Y">Framebuffer pixels from the top edge.</param>
/// <param name="DeltaX">
/// Movement to the right since the last such event, in screen points: the same on screens of any pixel density.
/// </param>
/// <param name="DeltaY">Movement downwards since the last such event, in screen points.</param>
public sealed record MouseMoved(double X, double Y, double DeltaX, double DeltaY) : WindowEvent;
