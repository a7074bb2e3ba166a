namespace FractalEngine.Render.Gl;

/// <summary>OpenGL refused something: a shader, a framebuffer, an allocation. The message says what and why.</summary>
public sealed class GlException : Exception
{
    /// <summary>With a message.</summary>
    public GlException(string message)
        : base(message)
    {
    }

    /// <summary>With a message and a cause.</summary>
    public GlException(string message, Exception innerException)
        : base(message, innerException)
    {
    }

    /// <summary>Without details.</summary>
    public GlException()
    {
    }
}
