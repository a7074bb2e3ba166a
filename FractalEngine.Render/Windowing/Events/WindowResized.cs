namespace FractalEngine.Render.Windowing.Events;

/// <summary>The framebuffer of the window changed its size.</summary>
/// <param name="Width">New width in framebuffer pixels.</param>
/// <param name="Height">New height in framebuffer pixels.</param>
public sealed record WindowResized(int Width, int Height) : WindowEvent;
