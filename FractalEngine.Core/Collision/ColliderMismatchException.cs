
namespace FractalEngine.Core.Collision;

/// <summary>A collider was asked for that does not fit the model. The message says which do.</summary>
public sealed class ColliderMismatchException : Exception
{
    /// <summary>With a message that says which colliders fit.</summary>
    public ColliderMismatchException(string message)
        : base(message)
    {
    }

    /// <summary>With a message and a cause.</summary>
    public ColliderMismatchException(string message, Exception innerException)
        : base(message, innerException)
    {
    }

    /// <summary>Without details.</summary>
    public ColliderMismatchException()
    {
    }
}
