namespace FractalEngine.Render.Windowing;

/// <summary>There is no display, or no OpenGL 3.3 on it. The message is one line that says which.</summary>
public sealed class GraphicsUnavailableException : Exception
{
    /// <summary>With a message of one line.</summary>
    public GraphicsUnavailableException(string message)
        : base(message)
    {
    }

    /// <summary>With a message of one line and a cause.</summary>
    public GraphicsUnavailableException(string message, Exception innerException)
        : base(message, innerException)
    {
    }

    /// <summary>Without details.</summary>
    public GraphicsUnavailableException()
    {
    }
}
