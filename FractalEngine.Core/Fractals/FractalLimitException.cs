namespace FractalEngine.Core.Fractals;

/// <summary>A fractal was to be expanded or composed beyond a stated limit, which the message names.</summary>
public sealed class FractalLimitException : FractalEngineException
{
    /// <summary>Makes an error with a message of one line.</summary>
    public FractalLimitException(string message)
        : base(ErrorKind.Limit, message)
    {
    }

    /// <summary>Makes an error with a message of one line and a cause.</summary>
    public FractalLimitException(string message, Exception innerException)
        : base(ErrorKind.Limit, message, innerException)
    {
    }

    /// <summary>Makes an error without details.</summary>
    public FractalLimitException()
        : this("the fractal is beyond a limit")
    {
    }
}
