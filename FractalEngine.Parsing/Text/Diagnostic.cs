using System.Globalization;

namespace FractalEngine.Parsing.Text;

/// <summary>
/// Something to say about a place in a file. Written as one line that editors understand, followed by the source line and a
/// caret where there is a source line.
/// </summary>
/// <param name="File">As the user named it, or relative to that.</param>
/// <param name="Line">From 1.</param>
/// <param name="Column">In characters, from 1.</param>
/// <param name="Severity">An error stops the loading of the file, a warning does not.</param>
/// <param name="Message">One line, without a full stop.</param>
/// <param name="SourceLine">The line at fault; null where there is none to show.</param>
public sealed record Diagnostic(
    string File, int Line, int Column, DiagnosticSeverity Severity, string Message, string? SourceLine = null)
{
    // A file of one line of a million characters gives a message of one screen line all the same.
    private const int MaxShownWidth = 100;

    /// <summary>True when the file is well-formed but asks for more than a stated limit.</summary>
    public bool IsLimitExceeded { get; init; }

    /// <summary><c>file:line:column: error: message</c>, then the source line and a caret, indented by two blanks.</summary>
    public override string ToString()
    {
        var head = string.Create(
            CultureInfo.InvariantCulture,
            $"{File}:{Line}:{Column}: {(Severity == DiagnosticSeverity.Error ? "error" : "warning")}: {Message}");
        if (string.IsNullOrWhiteSpace(SourceLine))
        {
            return head;
        }

        var caret = Math.Min(Column - 1, SourceLine.Length);
        var start = caret < MaxShownWidth ? 0 : caret - (MaxShownWidth / 2);
        var shown = SourceLine[start..Math.Min(start + MaxShownWidth, SourceLine.Length)];
        // Tabs stay tabs under the caret, so that both lines shift alike; other control characters would spoil the terminal.
        var line = string.Concat(shown.Select(c => char.IsControl(c) && c != '\t' ? '?' : c));
        var padding = string.Concat(shown.Take(caret - start).Select(c => c == '\t' ? '\t' : ' '));
        return $"{head}\n  {line}\n  {padding}^";
    }
}
