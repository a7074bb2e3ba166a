using FractalEngine.Core.Files;
using FractalEngine.Core.Images;

namespace FractalEngine.Render.Images;

/// <summary>Reads image files, and writes PNG files.</summary>
public static class ImageFile
{
    /// <summary>The most pixels of an image that is read: 512 MiB, decoded.</summary>
    public const long MaxPixels = 1L << 27;

    // As many as the largest image has with 16 bits a sample.
    private const long MaxFileBytes = 8 * MaxPixels;

    /// <summary>Writes a PNG file. An existing file is replaced only once the new one is complete.</summary>
    /// <param name="image">At least one pixel.</param>
    /// <param name="path">Relative to the working directory, or absolute; its folder is created if it is missing.</param>
    /// <exception cref="ArgumentException">The image has no pixels, or not as many as its sides say.</exception>
    /// <exception cref="IOException">The file can't be written.</exception>
    public static void SavePng(this PixelImage image, string path) => AtomicFile.Write(path, stream => PngWriter.Write(image, stream));

    /// <summary>Reads a PNG, JPEG, BMP or TGA image. All but TGA are known by their first bytes, whatever their names are.</summary>
    /// <exception cref="IOException">The file can't be read, is damaged or of another format.</exception>
    /// <remarks>
    /// An image of more than <see cref="MaxPixels"/> pixels, or of more than its file can hold, is refused before memory is taken for it.
    /// Takes up to six times the memory of the decoded image for a moment. Costs 15 to 100 ns a pixel.
    /// </remarks>
    public static PixelImage Load(string path)
    {
        try
        {
            // Opening a pipe waits for a writer, perhaps for ever. It may have taken the place of an image that was checked before.
            if (FileTypes.IsSpecial(path))
            {
                throw new IOException("it is a pipe or a device");
            }

            using var stream = new FileStream(path, FileMode.Open, FileAccess.Read, FileShare.Read);
            return Load(stream, ImageHeader.IsTga(path));
        }
        catch (Exception exception) when (exception is IOException or UnauthorizedAccessException)
        {
            throw new IOException(Prefix(path) + exception.Message, exception);
        }
    }

    /// <summary>Tells why an image could not be loaded, without its path, for messages that name it already.</summary>
    internal static string ReasonWithoutPath(IOException exception, string path) =>
        exception.Message.StartsWith(Prefix(path), StringComparison.Ordinal) ? exception.Message[Prefix(path).Length..] : exception.Message;

    /// <summary>Reads an image from a stream that can seek, at its beginning.</summary>
    internal static PixelImage Load(Stream stream, bool isTga)
    {
        // The decoder knows more formats.
        if (ImageHeader.Read(stream, isTga) is not { } header)
        {
            throw new IOException("it is not a PNG, JPEG, BMP or TGA image");
        }

        if (stream.Length > MaxFileBytes)
        {
            throw new IOException($"the file has {stream.Length} bytes, more than the limit of {MaxFileBytes}");
        }

        if (header.PixelCount > MaxPixels)
        {
            throw new IOException($"an image of {header.Width}×{header.Height} pixels, more than the limit of {MaxPixels} in all");
        }

        if (header.FindFault(stream.Length) is { } fault)
        {
            throw new IOException($"it {fault}");
        }

        stream.Position = 0;
        var file = new byte[stream.Length];
        stream.ReadExactly(file);
        return ImageHeader.IsPng(file) && PngCheck.FindFault(file, header) is { } damage
            ? throw new IOException(damage)
            : ImageDecoder.Decode(file);
    }

    private static string Prefix(string path) => $"{path} can't be read: ";
}
