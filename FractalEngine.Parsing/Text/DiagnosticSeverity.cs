namespace FractalEngine.Parsing.Text;

/// <summary>How bad it is.</summary>
public enum DiagnosticSeverity
{
    /// <summary>Something was passed over.</summary>
    Warning,

    /// <summary>The file can't be loaded.</summary>
    Error,
}
