using FractalEngine.Core.Images;
using StbImageSharp;

namespace FractalEngine.Render.Images;

/// <summary>Decodes images with StbImageSharp (docs/decisions/0021-decoding-images.md).</summary>
internal static class ImageDecoder
{
    // The library keeps the reason of a failure in a static field.
    private static readonly Lock Gate = new();

    /// <summary>Decodes an image whose size, and whose chunks if it is a PNG image, were checked before.</summary>
    /// <param name="file">The whole file.</param>
    /// <returns>Samples of less than 8 bits are spread over the whole range, of those of 16 bits the upper 8 are taken.</returns>
    /// <exception cref="IOException">The image is damaged, or of a kind that the library does not know.</exception>
    public static PixelImage Decode(byte[] file)
    {
        using var stream = new FileBytes(file);
        lock (Gate)
        {
            StbImage.stbi__g_failure_reason = "wrong data";
            try
            {
                var image = ImageResult.FromStream(stream, ColorComponents.RedGreenBlueAlpha);
                // What lies beyond the end was taken for zeros, or for whatever the memory held.
                return stream.HasEnded ? throw new InvalidOperationException() : new PixelImage(image.Width, image.Height, image.Data);
            }
            catch (Exception exception) when (exception is InvalidOperationException or ArgumentException or IndexOutOfRangeException
                or OverflowException or OutOfMemoryException)
            {
                // Unknown chunks are named by their bytes, whatever these are.
                var reason = stream.HasEnded
                    ? "the file ends within it"
                    : string.Concat(StbImage.stbi__g_failure_reason.Where(static character => !char.IsControl(character)));
                throw new IOException($"it is damaged, or of a kind that can't be decoded: {reason}", exception);
            }
        }
    }

    /// <summary>A file that knows whether bytes beyond its end were asked for.</summary>
    private sealed class FileBytes(byte[] file) : MemoryStream(file)
    {
        public bool HasEnded { get; private set; }

        public override int ReadByte()
        {
            var value = base.ReadByte();
            HasEnded |= value < 0;
            return value;
        }

        public override int Read(byte[] buffer, int offset, int count)
        {
            var read = base.Read(buffer, offset, count);
            HasEnded |= read < count;
            return read;
        }

        // The library waits for a position at the end, and never finds one beyond.
        public override long Seek(long offset, SeekOrigin loc) => Position = Math.Min(base.Seek(offset, loc), Length);
    }
}
