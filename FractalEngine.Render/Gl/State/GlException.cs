using FractalEngine.Core;

namespace FractalEngine.Render.Gl.State;

/// <summary>The error of an OpenGL operation that failed, such as a shader or an allocation. The message says which and why.</summary>
/// <param name="message">One line, without a full stop.</param>
/// <param name="innerException">The cause, if another error was.</param>
public sealed class GlException(string message, Exception? innerException = null)
    : FractalEngineException(ErrorKind.Limit, message, innerException);
