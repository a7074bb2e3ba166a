namespace FractalEngine.Core.Colliders;

/// <summary>Thrown where a kind of collider can't serve a model; the message lists the kinds that can.</summary>
/// <param name="message">One line, without a full stop.</param>
/// <param name="innerException">The cause, if another error was.</param>
public sealed class ColliderMismatchException(string message, Exception? innerException = null)
    : FractalEngineException(ErrorKind.Input, message, innerException);
