namespace FractalEngine.Render.Ui;

/// <summary>What the mouse does to a handle in one build.</summary>
/// <param name="IsHot">Whether the pointer is over it, or drags it.</param>
/// <param name="Begins">Whether the button has just gone down on it.</param>
/// <param name="IsHeld">Whether the button is held since it went down on it.</param>
/// <param name="X">Pixels from the left edge of the frame to the pointer.</param>
/// <param name="Y">Pixels from the upper edge of the frame to the pointer.</param>
/// <param name="IsControlHeld">Whether the key Ctrl is held.</param>
public readonly record struct UiHandle(bool IsHot, bool Begins, bool IsHeld, double X, double Y, bool IsControlHeld);
