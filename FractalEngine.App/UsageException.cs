namespace FractalEngine.App;

/// <summary>The command line is well-formed, but asks for something that can't be done with the file it names.</summary>
internal sealed class UsageException(string message) : Exception(message);
