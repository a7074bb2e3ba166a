namespace FractalEngine.Core.Fractals;

/// <summary>A fractal was to be expanded or composed beyond a stated limit. The message names the limit.</summary>
public sealed class FractalLimitException : Exception
{
    /// <summary>With a message that names the limit.</summary>
    public FractalLimitException(string message)
        : base(message)
    {
    }

    /// <summary>With a message and a cause.</summary>
    public FractalLimitException(string message, Exception innerException)
        : base(message, innerException)
    {
    }

    /// <summary>Without details.</summary>
    public FractalLimitException()
    {
    }
}
