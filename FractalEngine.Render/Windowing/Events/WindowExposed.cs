namespace FractalEngine.Render.Windowing.Events;

/// <summary>A part of the window's contents was lost and must be presented again.</summary>
public sealed record WindowExposed : WindowEvent;
