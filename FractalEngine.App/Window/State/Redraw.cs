namespace FractalEngine.App.Window.State;

/// <summary>The layers of a window's contents that are out of date.</summary>
[Flags]
internal enum Redraw
{
    /// <summary>Everything shown is up to date.</summary>
    None = 0,

    /// <summary>The overlay has changed. The frame below it is presented again without drawing.</summary>
    Overlay = 1,

    /// <summary>The scene has changed, so a new frame must be drawn.</summary>
    Scene = 2,
}
