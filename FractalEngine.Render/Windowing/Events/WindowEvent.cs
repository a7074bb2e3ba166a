namespace FractalEngine.Render.Windowing.Events;

/// <summary>
/// An event of a window. Positions are framebuffer pixels from the upper left corner of its contents, with y downwards.
/// </summary>
public abstract record WindowEvent;
