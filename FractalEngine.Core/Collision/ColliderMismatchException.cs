namespace FractalEngine.Core.Collision;

/// <summary>Thrown where a kind of collider can't serve a model; the message lists the kinds that can.</summary>
public sealed class ColliderMismatchException : FractalEngineException
{
    /// <summary>Makes an error with a message of one line.</summary>
    public ColliderMismatchException(string message)
        : base(ErrorKind.Input, message)
    {
    }

    /// <summary>Makes an error with a message of one line and a cause.</summary>
    public ColliderMismatchException(string message, Exception innerException)
        : base(ErrorKind.Input, message, innerException)
    {
    }

    /// <summary>Makes an error without details.</summary>
    public ColliderMismatchException()
        : this("the collider does not fit the model")
    {
    }
}
