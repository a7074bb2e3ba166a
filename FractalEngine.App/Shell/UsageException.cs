using System.Diagnostics.CodeAnalysis;

namespace FractalEngine.App.Shell;

/// <summary>Thrown where a well-formed command line asks for something that its file does not support.</summary>
/// <param name="message">The message for the user, without a full stop.</param>
/// <param name="excerpt">The faulty value with a caret below, on lines of their own; null where the message tells enough.</param>
internal sealed class UsageException(string message, string? excerpt = null) : Exception(message)
{
    /// <summary>The faulty value with a caret below, on lines of their own; null where the message tells enough.</summary>
    public string? Excerpt { get; } = excerpt;

    /// <summary>Throws where a command line asks for what can't be.</summary>
    /// <param name="isWrong">Whether it does.</param>
    /// <param name="message">The message for the user, without a full stop.</param>
    public static void ThrowIf([DoesNotReturnIf(true)] bool isWrong, string message)
    {
        if (isWrong)
        {
            throw new UsageException(message);
        }
    }
}
