namespace FractalEngine.App;

/// <summary>Thrown where a well-formed command line asks for something that its file does not support.</summary>
/// <param name="message">The message for the user, without a full stop.</param>
internal sealed class UsageException(string message) : Exception(message);
