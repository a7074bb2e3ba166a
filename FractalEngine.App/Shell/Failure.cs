using FractalEngine.Core;
using FractalEngine.Core.Colliders;
using FractalEngine.Parsing.Text;

namespace FractalEngine.App.Shell;

/// <summary>
/// The exit code and the message of an error. This is the only place that maps exceptions to exit codes.
/// </summary>
/// <param name="ExitCode">One of <see cref="Shell.ExitCode"/>.</param>
/// <param name="Text">The text for stderr: one line, with a source line and a caret below if the error is in a file.</param>
internal sealed record Failure(int ExitCode, string Text)
{
    /// <summary>Maps an exception of any type, so that no command prints a stack trace.</summary>
    public static Failure Of(Exception exception) => exception switch
    {
        SourceException source => new(CodeOf(source.Kind), source.Diagnostic.ToString()),
        // An option asked for the collider, or a line of the scene that is valid in other scenes.
        ColliderMismatchException => new(Shell.ExitCode.WrongUsage, Line(exception.Message)),
        UsageException { Excerpt: { } excerpt } => new(Shell.ExitCode.WrongUsage, $"{Line(exception.Message)}\n{excerpt}"),
        UsageException => new(Shell.ExitCode.WrongUsage, Line(exception.Message)),
        FractalEngineException engine => new(CodeOf(engine.Kind), Line(engine.Message)),
        OutOfMemoryException => new(Shell.ExitCode.OverLimit, Line("the machine's memory does not suffice")),
        IOException when IsCurrentFolderGone() => new(Shell.ExitCode.WrongUsage, Line("the current folder has been removed")),
        // Only signals cancel.
        OperationCanceledException => new(Shell.ExitCode.Interrupted, Line("interrupted")),
        // Input that can't be read has become a SourceException already, so this is about an output.
        IOException or UnauthorizedAccessException => new(Shell.ExitCode.WrongUsage, Line(exception.Message)),
        AggregateException { InnerExceptions: [var only] } => Of(only),
        _ => new(Shell.ExitCode.Internal, Line($"internal error, please report it: {exception.GetType().Name}: {OneLine(exception)}")),
    };

    private static int CodeOf(ErrorKind kind) => kind switch
    {
        ErrorKind.Limit => Shell.ExitCode.OverLimit,
        ErrorKind.Unavailable => Shell.ExitCode.NoGraphics,
        _ => Shell.ExitCode.BadInput,
    };

    private static bool IsCurrentFolderGone()
    {
        try
        {
            return !Directory.Exists(Directory.GetCurrentDirectory());
        }
        catch (IOException)
        {
            return true;
        }
    }

    private static string Line(string message) => $"error: {DisplayText.Escape(message)}";

    /// <summary>Formats the message on one line, with the method that threw in place of a stack trace.</summary>
    private static string OneLine(Exception exception)
    {
        var message = exception.Message.ReplaceLineEndings(" ");
        return exception.TargetSite is { DeclaringType.FullName: { } type } site ? $"{message} (in {type}.{site.Name})" : message;
    }
}
