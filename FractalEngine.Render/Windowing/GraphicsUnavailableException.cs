using FractalEngine.Core;

namespace FractalEngine.Render.Windowing;

/// <summary>The error of a system without a display, or without OpenGL 3.3 on it. The message says which.</summary>
public sealed class GraphicsUnavailableException : FractalEngineException
{
    /// <summary>Creates an error with a message of one line.</summary>
    public GraphicsUnavailableException(string message)
        : base(ErrorKind.Unavailable, message)
    {
    }

    /// <summary>Creates an error with a message of one line and a cause.</summary>
    public GraphicsUnavailableException(string message, Exception innerException)
        : base(ErrorKind.Unavailable, message, innerException)
    {
    }

    /// <summary>Creates an error without details.</summary>
    public GraphicsUnavailableException()
        : this("there is no display with OpenGL 3.3")
    {
    }
}
