namespace FractalEngine.Render.Ui.Overlays;

/// <summary>A line of text, or a row of a table with two columns. Long lines of one column are wrapped.</summary>
/// <param name="Text">Text of the line, or of the first column.</param>
/// <param name="SecondColumn">Text of the second column; null for a line of one column.</param>
/// <param name="Tone">Tone of the line. In a table it applies to the second column, and the first is accented.</param>
public readonly record struct OverlayLine(string Text, string? SecondColumn = null, OverlayTone Tone = OverlayTone.Normal)
{
    /// <summary>What a click on the line answers; null for a line that is only read.</summary>
    public int? Answer { get; init; }
}
