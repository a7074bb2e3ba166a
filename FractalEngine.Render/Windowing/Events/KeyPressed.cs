using FractalEngine.Render.Windowing.Keyboard;

namespace FractalEngine.Render.Windowing.Events;

/// <summary>A key went down, or repeats while it is held.</summary>
/// <param name="Key">Key that went down.</param>
/// <param name="Modifiers">Modifier keys that are held, the key itself included.</param>
/// <param name="IsRepeat">Whether the key was down already.</param>
public sealed record KeyPressed(Key Key, KeyModifiers Modifiers, bool IsRepeat) : WindowEvent;
