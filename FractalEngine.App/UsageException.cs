namespace FractalEngine.App;

/// <summary>Thrown where a well-formed command line asks for something impossible, such as an operation that the file does not support.</summary>
/// <param name="message">The message for the user, without a full stop.</param>
internal sealed class UsageException(string message) : Exception(message);
