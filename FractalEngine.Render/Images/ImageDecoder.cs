using FractalEngine.Core.Images;
using StbImageSharp;

namespace FractalEngine.Render.Images;

/// <summary>Decodes images with StbImageSharp (docs/decisions/0021-decoding-images.md).</summary>
internal static class ImageDecoder
{
    // What the library says of an image that is no PNG image; it may fail later without another reason.
    private const string NoReason = "bad png sig";

    // The library keeps the reason of a failure in a static field.
    private static readonly Lock Gate = new();

    // The marker EOI (T.81, §B.2.1). At a wrong marker the library stops reading, and shows what it has.
    private static ReadOnlySpan<byte> EndOfJpeg => [0xFF, 0xD9];

    /// <summary>Decodes an image whose size, and whose chunks if it is a PNG image, were checked before.</summary>
    /// <param name="file">The whole file.</param>
    /// <returns>Samples of less than 8 bits are spread over the whole range, of those of 16 bits the upper 8 are taken.</returns>
    /// <exception cref="IOException">The image is damaged, or of a kind that the library does not know.</exception>
    public static PixelImage Decode(byte[] file)
    {
        using var stream = new FileBytes(file);
        lock (Gate)
        {
            StbImage.stbi__g_failure_reason = NoReason;
            try
            {
                var image = ImageResult.FromStream(stream, ColorComponents.RedGreenBlueAlpha);
                // What is missing was taken for zeros, or for whatever the memory held.
                var isWhole = !stream.HasEnded
                    && (file is not [0xFF, 0xD8, ..] || file.AsSpan(0, (int)stream.Position).EndsWith(EndOfJpeg));
                return isWhole ? new PixelImage(image.Width, image.Height, image.Data) : throw new InvalidOperationException();
            }
            catch (Exception exception) when (exception is InvalidOperationException or ArgumentException or IndexOutOfRangeException
                or OverflowException or OutOfMemoryException)
            {
                var reason = stream.HasEnded ? "the file ends within it"
                    : StbImage.stbi__g_failure_reason == NoReason ? "wrong data"
                    : StbImage.stbi__g_failure_reason;
                // Unknown chunks are named by their bytes, whatever these are.
                reason = string.Concat(reason.Where(static character => !char.IsControl(character)));
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
