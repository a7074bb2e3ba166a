namespace FractalEngine.Render.Images;

/// <summary>An image file can't be read.</summary>
/// <param name="path">Path of the file.</param>
/// <param name="reason">Why, without the path.</param>
/// <param name="innerException">What the decoder or the system said.</param>
internal sealed class ImageFileException(string path, string reason, Exception innerException)
    : IOException($"{path} can't be read: {reason}", innerException)
{
    /// <summary>Why, without the path, for messages that name it already.</summary>
    public string Reason { get; } = reason;
}
