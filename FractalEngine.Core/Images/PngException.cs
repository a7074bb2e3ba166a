namespace FractalEngine.Core.Images;

/// <summary>A file is no PNG image, is damaged or is beyond a limit. The message is one line and begins with the offset.</summary>
/// <param name="offset">Bytes from the beginning of the image.</param>
/// <param name="problem">What is wrong there, as part of a sentence.</param>
/// <param name="inner">What was caught, if anything.</param>
public sealed class PngException(long offset, string problem, Exception? inner = null)
    : FractalEngineException(ErrorKind.Input, FormattableString.Invariant($"byte {offset}: {problem}"), inner)
{
    /// <summary>
    /// Bytes from the beginning of the image to what is wrong. Compressed pixels are read ahead: for those it is how far the file was read.
    /// </summary>
    public long Offset { get; } = offset;
}
