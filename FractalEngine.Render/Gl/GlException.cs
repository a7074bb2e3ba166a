using FractalEngine.Core;

namespace FractalEngine.Render.Gl;

/// <summary>OpenGL refused something: a shader, a framebuffer or an allocation; the message says what and why.</summary>
public sealed class GlException : FractalEngineException
{
    /// <summary>Makes an error with a message of one line.</summary>
    public GlException(string message)
        : base(ErrorKind.Limit, message)
    {
    }

    /// <summary>Makes an error with a message of one line and a cause.</summary>
    public GlException(string message, Exception innerException)
        : base(ErrorKind.Limit, message, innerException)
    {
    }

    /// <summary>Makes an error without details.</summary>
    public GlException()
        : this("OpenGL refused a request")
    {
    }
}
