namespace FractalEngine.Parsing.Text;

/// <summary>A fault that many lines may have: one warning at the first of them tells their number.</summary>
/// <param name="plural">What is counted.</param>
internal sealed class RepeatedWarning(string plural)
{
    private int _count;
    private SourcePosition? _first;
    private string? _message;

    /// <summary>Counts one more of the faults. Always returns true.</summary>
    /// <param name="position">Where it is.</param>
    /// <param name="message">Tells of it, without a full stop; only that of the first is used.</param>
    public bool Add(SourcePosition position, string message)
    {
        _first ??= position;
        _message ??= message;
        _count++;
        return true;
    }

    /// <summary>Returns the warning; null without a fault.</summary>
    public Diagnostic? ToDiagnostic() =>
        _first?.Diagnose(_count == 1 ? _message! : $"{_message} ({_count} {plural} in all)", DiagnosticSeverity.Warning);
}
