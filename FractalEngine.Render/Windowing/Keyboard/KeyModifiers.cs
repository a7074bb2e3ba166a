namespace FractalEngine.Render.Windowing.Keyboard;

/// <summary>Modifier keys that are held during an event.</summary>
[Flags]
public enum KeyModifiers
{
    /// <summary>No modifier key is held.</summary>
    None = 0,

    /// <summary>A shift key is held, left or right.</summary>
    Shift = 1,

    /// <summary>A control key is held, left or right.</summary>
    Control = 2,

    /// <summary>An alt key is held, left or right.</summary>
    Alt = 4,
}
