using FractalEngine.Core;

namespace FractalEngine.Render.Windowing;

/// <summary>The error of a system without a display, or without OpenGL 3.3 on it. The message says which.</summary>
/// <param name="message">One line, without a full stop.</param>
/// <param name="innerException">The cause, if another error was.</param>
public sealed class GraphicsUnavailableException(string message, Exception? innerException = null)
    : FractalEngineException(ErrorKind.Unavailable, message, innerException);
