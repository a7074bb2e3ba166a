namespace FractalEngine.Render.Ui;

/// <summary>A line of text, or a row of a table of two columns. Long lines of one column are wrapped.</summary>
/// <param name="Text">The line, or the first column.</param>
/// <param name="SecondColumn">The second column, or null.</param>
/// <param name="Tone">Of the line; in a table of the second column, while the first stands out.</param>
public readonly record struct OverlayLine(string Text, string? SecondColumn = null, OverlayTone Tone = OverlayTone.Normal)
{
    /// <summary>A plain line.</summary>
    public static implicit operator OverlayLine(string text) => new(text);

    /// <summary>A plain line.</summary>
    public static OverlayLine ToOverlayLine(string text) => new(text);
}
