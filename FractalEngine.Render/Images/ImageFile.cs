using FractalEngine.Core.Files;
using FractalEngine.Core.Images;

namespace FractalEngine.Render.Images;

/// <summary>Reads and writes image files: PNG by the engine itself; JPEG, BMP and TGA are read with SDL2_image.</summary>
public static class ImageFile
{
    private const string InstallHint =
        "it is no PNG image, and other formats need SDL2_image "
        + "(Debian: libsdl2-image-2.0-0; Windows: SDL2.dll and SDL2_image.dll beside the program; macOS: brew install sdl2_image)";

    private const int BufferBytes = 1 << 16;

    /// <summary>Writes a PNG file. An existing file is replaced only once the new one is complete. Needs no library.</summary>
    /// <param name="image">At least one pixel.</param>
    /// <param name="path">Relative to the working directory, or absolute; its folder is created if it is missing.</param>
    /// <exception cref="ArgumentException">The image has no pixels, or not as many as its sides say.</exception>
    /// <exception cref="IOException">The file can't be written.</exception>
    public static void SavePng(this PixelImage image, string path) => AtomicFile.Write(path, stream => PngWriter.Write(image, stream));

    /// <summary>Reads an image: PNG, known by its first bytes whatever its name is, or JPEG, BMP or TGA.</summary>
    /// <exception cref="IOException">
    /// The file can't be read, is damaged or of another format; or it is no PNG, and SDL2_image is missing.
    /// </exception>
    /// <remarks>
    /// An image of more than <see cref="PngReader.DefaultMaxPixels"/> pixels, or of more than its file can hold, is refused before memory
    /// is taken for it.
    /// </remarks>
    public static PixelImage Load(string path) => Load(path, SdlImage.Read);

    /// <summary>As <see cref="Load(string)"/>, with another reader for what is no PNG.</summary>
    internal static PixelImage Load(string path, Func<string, PixelImage> loadOther)
    {
        try
        {
            return LoadPng(path) ?? loadOther(path);
        }
        catch (Exception exception) when (exception is DllNotFoundException or EntryPointNotFoundException)
        {
            throw new IOException(Prefix(path) + InstallHint, exception);
        }
        catch (Exception exception) when (exception is PngException or IOException or UnauthorizedAccessException)
        {
            throw new IOException(Prefix(path) + exception.Message, exception);
        }
    }

    /// <summary>Tells why an image could not be loaded, without its path, for messages that name it already.</summary>
    internal static string ReasonWithoutPath(IOException exception, string path) =>
        exception.Message.StartsWith(Prefix(path), StringComparison.Ordinal) ? exception.Message[Prefix(path).Length..] : exception.Message;

    private static string Prefix(string path) => $"{path} can't be read: ";

    /// <summary>Null where the file is no PNG. Throws where no decoder should take memory for it.</summary>
    private static PixelImage? LoadPng(string path)
    {
        // Opening a pipe waits for a writer, perhaps for ever. It may have taken the place of an image that was checked before.
        if (FileTypes.IsSpecial(path))
        {
            throw new IOException("it is a pipe or a device");
        }

        using var stream = new FileStream(path, FileMode.Open, FileAccess.Read, FileShare.Read, BufferBytes, FileOptions.SequentialScan);
        Span<byte> head = stackalloc byte[8];
        var count = stream.ReadAtLeast(head, head.Length, throwOnEndOfStream: false);
        stream.Position = 0;
        var isPng = PngReader.IsPng(head[..count]);
        CheckHeader(stream, path, isPng);
        stream.Position = 0;
        return isPng ? PngReader.Read(stream) : null;
    }

    /// <summary>Throws where a file is too short for the pixels that it states, or has too many for another decoder.</summary>
    private static void CheckHeader(Stream stream, string path, bool isPng)
    {
        if (ImageHeader.Read(stream, ImageHeader.IsTga(path)) is not { } header)
        {
            // The library knows more formats, of which some hang, or take gigabytes for a file of a few bytes.
            throw new IOException(isPng ? "the file ends within its header" : "it is not a PNG, JPEG, BMP or TGA image");
        }

        if (!isPng && header.PixelCount > PngReader.DefaultMaxPixels)
        {
            throw new IOException(
                $"an image of {header.Width}×{header.Height} pixels, more than the limit of {PngReader.DefaultMaxPixels} in all");
        }

        if (header.FindFault(stream) is { } fault)
        {
            throw new IOException($"it {fault}");
        }
    }
}
