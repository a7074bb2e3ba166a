namespace FractalEngine.Render.Windowing;

/// <summary>Something that happened to a window. Positions are framebuffer pixels from the upper left corner, y downwards.</summary>
public abstract record WindowEvent;

/// <summary>A key went down, or is held and repeats.</summary>
public sealed record KeyPressed(Key Key, KeyModifiers Modifiers, bool IsRepeat) : WindowEvent;

/// <summary>A key went up.</summary>
public sealed record KeyReleased(Key Key, KeyModifiers Modifiers) : WindowEvent;

/// <summary>A mouse button went down.</summary>
public sealed record MousePressed(MouseButton Button, double X, double Y, KeyModifiers Modifiers) : WindowEvent;

/// <summary>A mouse button went up.</summary>
public sealed record MouseReleased(MouseButton Button, double X, double Y, KeyModifiers Modifiers) : WindowEvent;

/// <summary>The mouse moved. In <see cref="RenderWindow.RelativeMouse"/> mode only the differences mean something.</summary>
/// <param name="X">Pixels from the left.</param>
/// <param name="Y">Pixels from the top.</param>
/// <param name="DeltaX">Pixels to the right since the last such event.</param>
/// <param name="DeltaY">Pixels downwards since the last such event.</param>
public sealed record MouseMoved(double X, double Y, double DeltaX, double DeltaY) : WindowEvent;

/// <summary>The wheel turned.</summary>
/// <param name="Notches">Away from the user is positive; touchpads give fractions.</param>
/// <param name="Modifiers">The modifier keys that are held.</param>
public sealed record WheelTurned(double Notches, KeyModifiers Modifiers) : WindowEvent;

/// <summary>The window has another size, in framebuffer pixels.</summary>
public sealed record WindowResized(int Width, int Height) : WindowEvent;

/// <summary>Some of the window's contents are gone and must be presented again.</summary>
public sealed record WindowExposed : WindowEvent;

/// <summary>Key strokes go to another window from now on: keys that were held may never be released.</summary>
public sealed record FocusLost : WindowEvent;

/// <summary>The window was hidden or minimised, or came back.</summary>
public sealed record VisibilityChanged(bool IsVisible) : WindowEvent;

/// <summary>A file was dropped on the window.</summary>
/// <param name="Path">Its full path.</param>
public sealed record FileDropped(string Path) : WindowEvent;

/// <summary>The user wants the window closed. It stays open until it is disposed.</summary>
public sealed record CloseRequested : WindowEvent;
