using FractalEngine.Core;
using FractalEngine.Core.Collision;
using FractalEngine.Parsing.Text;

namespace FractalEngine.App;

/// <summary>
/// What the user is told of an error: the exit code and the text for stderr. The one place that knows which error is which.
/// </summary>
/// <param name="ExitCode">See <see cref="App.ExitCode"/>.</param>
/// <param name="Text">One line; a line of source and a caret follow where the error is in a file.</param>
internal sealed record Failure(int ExitCode, string Text)
{
    /// <summary>Translates an error of any kind, so that no command prints a stack trace.</summary>
    public static Failure Of(Exception exception) => exception switch
    {
        SourceException source => new(CodeOf(source.Kind), source.Diagnostic.ToString()),
        // The collider that does not fit was asked for by an option, or by a line of the scene that fits other scenes.
        ColliderMismatchException or UsageException => new(App.ExitCode.WrongUsage, Line(exception.Message)),
        FractalEngineException engine => new(CodeOf(engine.Kind), Line(engine.Message)),
        OutOfMemoryException => new(App.ExitCode.OverLimit, Line("the machine's memory does not suffice")),
        OperationCanceledException => new(App.ExitCode.Interrupted, Line(exception.Message)),
        // Input that can't be read has become a SourceException already, so this is about an output.
        IOException or UnauthorizedAccessException => new(App.ExitCode.WrongUsage, Line(exception.Message)),
        AggregateException { InnerExceptions: [var only] } => Of(only),
        _ => new(App.ExitCode.Internal, Line($"internal error, please report it: {exception.GetType().Name}: {OneLine(exception)}")),
    };

    private static int CodeOf(ErrorKind kind) => kind switch
    {
        ErrorKind.Limit => App.ExitCode.OverLimit,
        ErrorKind.Unavailable => App.ExitCode.NoGraphics,
        _ => App.ExitCode.BadInput,
    };

    private static string Line(string message) => $"error: {message}";

    /// <summary>The message with the method that threw, since nobody sees a stack trace.</summary>
    private static string OneLine(Exception exception)
    {
        var message = exception.Message.ReplaceLineEndings(" ");
        return exception.TargetSite is { DeclaringType.FullName: { } type } site ? $"{message} (in {type}.{site.Name})" : message;
    }
}
