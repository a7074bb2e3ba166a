namespace FractalEngine.Render.Ui;

/// <summary>Where a panel of the user interface stands.</summary>
public enum UiDock
{
    /// <summary>The column at the left edge.</summary>
    Left,

    /// <summary>The column at the right edge.</summary>
    Right,

    /// <summary>Where the user has moved it.</summary>
    Floating,
}
