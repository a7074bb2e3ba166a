namespace FractalEngine.Parsing.Text;

/// <summary>Position in a text, for messages about it.</summary>
/// <param name="Source">The text, which may be an excerpt of a file.</param>
/// <param name="Offset">Number of characters of that text before the position.</param>
public sealed record SourcePosition(SourceText Source, int Offset)
{
    /// <summary>Creates a diagnostic for the position. Cost O(offset).</summary>
    /// <param name="message">One line of text without a full stop.</param>
    /// <param name="severity">Severity of the diagnostic.</param>
    public Diagnostic Diagnose(string message, DiagnosticSeverity severity = DiagnosticSeverity.Error) =>
        Source.Diagnose(Offset, message, severity);
}
