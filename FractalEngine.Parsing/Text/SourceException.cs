using FractalEngine.Core;

namespace FractalEngine.Parsing.Text;

/// <summary>A file can't be loaded; the diagnostic says why and where, for syntax and meaning alike.</summary>
public sealed class SourceException : FractalEngineException
{
    /// <summary>Makes the error of a diagnostic.</summary>
    public SourceException(Diagnostic diagnostic)
        : base(diagnostic.IsLimitExceeded ? ErrorKind.Limit : ErrorKind.Input, diagnostic.ToString()) => Diagnostic = diagnostic;

    /// <summary>Makes an error about a file as a whole.</summary>
    public SourceException(string file, string message, bool isLimitExceeded = false)
        : this(new(file, 1, 1, DiagnosticSeverity.Error, message) { IsLimitExceeded = isLimitExceeded })
    {
    }

    /// <summary>What is wrong, and where in which file.</summary>
    public Diagnostic Diagnostic { get; }
}
