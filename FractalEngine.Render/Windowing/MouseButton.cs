namespace FractalEngine.Render.Windowing;

/// <summary>The buttons of a mouse.</summary>
public enum MouseButton
{
    /// <summary>The main button.</summary>
    Left,

    /// <summary>The wheel as a button.</summary>
    Middle,

    /// <summary>The second button.</summary>
    Right,

    /// <summary>Any further one.</summary>
    Other,
}
