namespace FractalEngine.Parsing.Text;

/// <summary>Severity of a diagnostic about a file.</summary>
public enum DiagnosticSeverity
{
    /// <summary>Something in the file was ignored; loading goes on.</summary>
    Warning,

    /// <summary>The file can't be loaded because of this.</summary>
    Error,
}
