namespace FractalEngine.Core.Fractals.Descriptions;

/// <summary>A fractal was to be expanded or composed beyond a stated limit, which the message names.</summary>
/// <param name="message">One line, without a full stop.</param>
/// <param name="innerException">The cause, if another error was.</param>
public sealed class FractalLimitException(string message, Exception? innerException = null)
    : FractalEngineException(ErrorKind.Limit, message, innerException);
