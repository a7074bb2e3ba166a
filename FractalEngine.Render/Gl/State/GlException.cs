using FractalEngine.Core;

namespace FractalEngine.Render.Gl.State;

/// <summary>The error of an OpenGL operation that failed, such as a shader or an allocation. The message says which and why.</summary>
public sealed class GlException : FractalEngineException
{
    /// <summary>Creates an error with a message of one line.</summary>
    public GlException(string message)
        : base(ErrorKind.Limit, message)
    {
    }

    /// <summary>Creates an error with a message of one line and a cause.</summary>
    public GlException(string message, Exception innerException)
        : base(ErrorKind.Limit, message, innerException)
    {
    }

    /// <summary>Creates an error without details.</summary>
    public GlException()
        : this("OpenGL refused a request")
    {
    }
}
