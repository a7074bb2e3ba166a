namespace FractalEngine.Parsing.Text;

/// <summary>A file can't be loaded; the diagnostic says why and where. Syntax and meaning alike.</summary>
public sealed class SourceException : Exception
{
    /// <summary>For a place in a file.</summary>
    public SourceException(Diagnostic diagnostic)
        : base(diagnostic.ToString()) => Diagnostic = diagnostic;

    /// <summary>For a file as a whole.</summary>
    public SourceException(string file, string message, bool isLimitExceeded = false)
        : this(new(file, 1, 1, DiagnosticSeverity.Error, message) { IsLimitExceeded = isLimitExceeded })
    {
    }

    /// <summary>What is wrong, and where.</summary>
    public Diagnostic Diagnostic { get; }
}
