using FractalEngine.Render.Windowing.Keyboard;

namespace FractalEngine.Render.Windowing.Events;

/// <summary>The mouse wheel turned, or a touchpad scrolled.</summary>
/// <param name="Notches">Number of notches, positive away from the user. Touchpads give fractions.</param>
/// <param name="Modifiers">Modifier keys that are held.</param>
public sealed record WheelTurned(double Notches, KeyModifiers Modifiers) : WindowEvent;
