namespace FractalEngine.Render.Ui.Input;

/// <summary>What mouse and keyboard do to a widget in one build.</summary>
/// <param name="HasFocus">Whether it has the keyboard.</param>
/// <param name="IsHot">Whether the pointer is over it, or it holds the pointer.</param>
/// <param name="IsPressed">Whether the button has just gone down on it.</param>
/// <param name="IsHeld">Whether the button is held since it went down on it.</param>
/// <param name="IsActivated">Whether it was clicked, or Enter or Space was pressed for it.</param>
internal readonly record struct UiTouch(bool HasFocus, bool IsHot, bool IsPressed, bool IsHeld, bool IsActivated);
