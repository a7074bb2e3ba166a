namespace FractalEngine.Core.Scenes;

/// <summary>An object of a scene can't be what the scene declares, such as a body without size.</summary>
/// <param name="objectIndex">Index of the object in the scene, from 0.</param>
/// <param name="kind">Decides the exit code of the program.</param>
/// <param name="message">One line that names the object, without a full stop.</param>
/// <param name="innerException">The cause, if another error was.</param>
public sealed class SceneObjectException(int objectIndex, ErrorKind kind, string message, Exception? innerException = null)
    : FractalEngineException(kind, message, innerException)
{
    /// <summary>Index of the object in the scene, from 0.</summary>
    public int ObjectIndex { get; } = objectIndex;
}
