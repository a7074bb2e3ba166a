namespace FractalEngine.Render.Ui;

/// <summary>What a text is, which decides its colour.</summary>
public enum OverlayTone
{
    /// <summary>What there is to say.</summary>
    Normal,

    /// <summary>Less important.</summary>
    Dim,

    /// <summary>Headings and keys.</summary>
    Accent,

    /// <summary>Something that the user should notice.</summary>
    Warning,
}
