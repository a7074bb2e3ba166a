using FractalEngine.Core;

namespace FractalEngine.Render.Windowing;

/// <summary>There is no display, or no OpenGL 3.3 on it; the message says which.</summary>
public sealed class GraphicsUnavailableException : FractalEngineException
{
    /// <summary>Makes an error with a message of one line.</summary>
    public GraphicsUnavailableException(string message)
        : base(ErrorKind.Unavailable, message)
    {
    }

    /// <summary>Makes an error with a message of one line and a cause.</summary>
    public GraphicsUnavailableException(string message, Exception innerException)
        : base(ErrorKind.Unavailable, message, innerException)
    {
    }

    /// <summary>Makes an error without details.</summary>
    public GraphicsUnavailableException()
        : this("there is no display with OpenGL 3.3")
    {
    }
}
