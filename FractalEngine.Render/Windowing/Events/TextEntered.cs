namespace FractalEngine.Render.Windowing.Events;

/// <summary>
/// The user typed text. It follows the <see cref="KeyPressed"/> of its key, and respects layout, dead keys and input methods.
/// </summary>
/// <param name="Text">One or more characters, none of them a control character.</param>
public sealed record TextEntered(string Text) : WindowEvent;
