namespace FractalEngine.Render.Windowing;

/// <summary>
/// The exception for a system without a display, or without OpenGL 3.3 on it. The message is one line that names the cause.
/// </summary>
public sealed class GraphicsUnavailableException : Exception
{
    /// <summary>Creates an exception with a message of one line.</summary>
    public GraphicsUnavailableException(string message)
        : base(message)
    {
    }

    /// <summary>Creates an exception with a message of one line and a cause.</summary>
    public GraphicsUnavailableException(string message, Exception innerException)
        : base(message, innerException)
    {
    }

    /// <summary>Creates an exception without details.</summary>
    public GraphicsUnavailableException()
    {
    }
}
