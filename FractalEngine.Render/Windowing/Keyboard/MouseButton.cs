namespace FractalEngine.Render.Windowing.Keyboard;

/// <summary>Buttons of a mouse that the engine distinguishes.</summary>
public enum MouseButton
{
    /// <summary>The main button of the mouse.</summary>
    Left,

    /// <summary>The middle button, usually the wheel.</summary>
    Middle,

    /// <summary>The secondary button of the mouse.</summary>
    Right,

    /// <summary>Any further button of the mouse.</summary>
    Other,
}
