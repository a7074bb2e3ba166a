namespace FractalEngine.Core;

/// <summary>The root of all errors that the engine reports about its input, its limits and its surroundings.</summary>
/// <remarks>
/// Wrong arguments of a caller stay <see cref="ArgumentException"/>, and files that can't be written stay <see cref="IOException"/>. The
/// message is one line for the user, without a full stop; an error in a file adds the line at fault below it.
/// </remarks>
/// <param name="kind">Decides the exit code of the program.</param>
/// <param name="message">One line, without a full stop.</param>
/// <param name="innerException">The cause, if another error was.</param>
public class FractalEngineException(ErrorKind kind, string message, Exception? innerException = null) : Exception(message, innerException)
{
    /// <summary>Makes an input error with a message.</summary>
    public FractalEngineException(string message)
        : this(ErrorKind.Input, message)
    {
    }

    /// <summary>Whether the input, a limit or the surroundings are at fault.</summary>
    public ErrorKind Kind { get; } = kind;
}
