using FractalEngine.Render.Windowing.Keyboard;

namespace FractalEngine.Render.Windowing.Events;

/// <summary>A mouse button went down inside the window.</summary>
/// <param name="Button">Button that went down.</param>
/// <param name="X">Framebuffer pixels from the left edge.</param>
/// <param name="Y">Framebuffer pixels from the top edge.</param>
/// <param name="Modifiers">Modifier keys that are held.</param>
public sealed record MousePressed(MouseButton Button, double X, double Y, KeyModifiers Modifiers) : WindowEvent;
