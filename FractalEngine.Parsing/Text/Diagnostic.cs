using System.Globalization;
using FractalEngine.Core;

namespace FractalEngine.Parsing.Text;

/// <summary>
/// Error or warning about a position in a file. Its text is one line that editors understand, followed by the source line and
/// a caret if the source line is known.
/// </summary>
/// <param name="File">Name of the file as the user wrote it, or relative to that.</param>
/// <param name="Line">Number of the line, from 1.</param>
/// <param name="Column">Number of the character in its line, from 1.</param>
/// <param name="Severity">An error prevents the file from loading, a warning does not.</param>
/// <param name="Message">One line of text without a full stop.</param>
/// <param name="SourceLine">The faulty line; null if there is none to show.</param>
public sealed record Diagnostic(
    string File, int Line, int Column, DiagnosticSeverity Severity, string Message, string? SourceLine = null)
{
    // Even a file with one line of a million characters must give a message that fits one line of a terminal.
    private const int MaxShownWidth = 100;

    /// <summary>True when the file is well-formed but exceeds a stated limit.</summary>
    public bool IsLimitExceeded { get; init; }

    /// <summary>Returns <c>file:line:column: error: message</c>, then the source line and a caret, indented by two spaces.</summary>
    public override string ToString()
    {
        var severity = Severity == DiagnosticSeverity.Error ? "error" : "warning";
        var head = string.Create(
            CultureInfo.InvariantCulture, $"{DisplayText.Escape(File)}:{Line}:{Column}: {severity}: {DisplayText.Escape(Message)}");
        if (string.IsNullOrWhiteSpace(SourceLine))
        {
            return head;
        }

        var caret = Math.Min(Column - 1, SourceLine.Length);
        var start = caret < MaxShownWidth ? 0 : caret - (MaxShownWidth / 2);
        var shown = SourceLine[start..Math.Min(start + MaxShownWidth, SourceLine.Length)];
        // Tabs stay tabs in both lines, so that the caret keeps its place. Others that would spoil the terminal take one column each.
        var line = string.Concat(shown.Select((c, i) => DisplayText.IsHidden(shown, i) ? '?' : c));
        var padding = string.Concat(shown.Take(caret - start).Select(c => c == '\t' ? '\t' : ' '));
        return $"{head}\n  {line}\n  {padding}^";
    }
}
