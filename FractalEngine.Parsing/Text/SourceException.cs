using FractalEngine.Core;

namespace FractalEngine.Parsing.Text;

/// <summary>A file can't be loaded; the diagnostic says why and where, for syntax and meaning alike.</summary>
/// <param name="diagnostic">What is wrong, and where.</param>
public sealed class SourceException(Diagnostic diagnostic)
    : FractalEngineException(diagnostic.IsLimitExceeded ? ErrorKind.Limit : ErrorKind.Input, diagnostic.ToString())
{
    /// <summary>Makes an error about a file as a whole.</summary>
    public SourceException(string file, string message, bool isLimitExceeded = false)
        : this(new(file, 1, 1, DiagnosticSeverity.Error, message) { IsLimitExceeded = isLimitExceeded })
    {
    }

    /// <summary>What is wrong, and where in which file.</summary>
    public Diagnostic Diagnostic { get; } = diagnostic;
}
