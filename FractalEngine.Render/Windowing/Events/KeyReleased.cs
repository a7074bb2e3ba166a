using FractalEngine.Render.Windowing.Keyboard;

namespace FractalEngine.Render.Windowing.Events;

/// <summary>A key went up after it was pressed.</summary>
/// <param name="Key">Key that went up.</param>
/// <param name="Modifiers">Modifier keys that are still held.</param>
public sealed record KeyReleased(Key Key, KeyModifiers Modifiers) : WindowEvent;
