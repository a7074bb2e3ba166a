namespace FractalEngine.Render.Gl;

/// <summary>The exception for an OpenGL operation that failed: a shader, a framebuffer or an allocation. The message names both.</summary>
public sealed class GlException : Exception
{
    /// <summary>Creates an exception with a message.</summary>
    public GlException(string message)
        : base(message)
    {
    }

    /// <summary>Creates an exception with a message and a cause.</summary>
    public GlException(string message, Exception innerException)
        : base(message, innerException)
    {
    }

    /// <summary>Creates an exception without details.</summary>
    public GlException()
    {
    }
}
