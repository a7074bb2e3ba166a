namespace FractalEngine.Render.Ui.Overlays;

/// <summary>Importance of a text, which decides its colour.</summary>
public enum OverlayTone
{
    /// <summary>Ordinary text of a panel.</summary>
    Normal,

    /// <summary>Text of less importance.</summary>
    Dim,

    /// <summary>Headings, and keys in a table.</summary>
    Accent,

    /// <summary>Text that the user should notice.</summary>
    Warning,
}
