using System.Buffers.Binary;
using System.IO.Compression;

namespace FractalEngine.Core.Images;

/// <summary>Writes PNG images (W3C, "Portable Network Graphics (PNG) Specification", third edition).</summary>
public static class PngWriter
{
    private const int DataChunkBytes = 1 << 16;
    private const int HeaderBytes = 13;

    // The colour type of pixels with samples of red, green, blue and alpha (table 8).
    private const byte Rgba = 6;

    /// <summary>Writes an image as RGBA of 8 bits, not interlaced, without any chunk that is not needed.</summary>
    /// <param name="image">At least one pixel.</param>
    /// <param name="stream">Where to; left open. Need not seek.</param>
    /// <exception cref="ArgumentException">The image has no pixels, or not as many as its sides say.</exception>
    /// <exception cref="IOException">The stream can't be written.</exception>
    /// <remarks>
    /// Equal images give equal bytes on one version of .NET: another one may bring another version of its compressor. Holds 6 rows and
    /// the compressed image beside the image. Costs 20 to 150 ns a pixel, nearly all of it compression.
    /// </remarks>
    public static void Write(PixelImage image, Stream stream)
    {
        ArgumentNullException.ThrowIfNull(image);
        Write(image.Width, image.Height, image.Pixels, 8, stream);
    }

    /// <summary>Writes an image as RGBA of 16 bits, in the same way.</summary>
    /// <inheritdoc cref="Write(PixelImage, Stream)"/>
    public static void WriteDeep(DeepImage image, Stream stream)
    {
        ArgumentNullException.ThrowIfNull(image);
        var bytes = new byte[2L * image.Pixels.Length];
        for (var i = 0; i < image.Pixels.Length; i++)
        {
            BinaryPrimitives.WriteUInt16BigEndian(bytes.AsSpan(2 * i), image.Pixels[i]);
        }

        Write(image.Width, image.Height, bytes, 16, stream);
    }

    private static void Write(int width, int height, byte[] bytes, int depth, Stream stream)
    {
        ArgumentNullException.ThrowIfNull(stream);
        if (width < 1 || height < 1 || bytes.Length != (long)depth / 2 * width * height)
        {
            throw new ArgumentException(
                $"{width}×{height} pixels of {bytes.Length} bytes, expected at least one pixel and {depth / 2} bytes for each",
                nameof(bytes));
        }

        var chunks = new PngChunkWriter(stream);
        chunks.WriteSignature();
        WriteHeader(width, height, chunks, depth);
        using var data = new MemoryStream();
        Compress(bytes, height, depth / 2, data);
        foreach (var chunk in data.ToArray().Chunk(DataChunkBytes))
        {
            chunks.Write(PngChunk.Data, chunk);
        }

        chunks.Write(PngChunk.End, []);
    }

    /// <summary>Writes the filtered and compressed rows of an image, the contents of its data chunks.</summary>
    /// <param name="bytes">All rows.</param>
    /// <param name="height">Number of rows.</param>
    /// <param name="pixelBytes">Bytes of a pixel: 4 or 8.</param>
    /// <param name="data">Where to.</param>
    internal static void Compress(byte[] bytes, int height, int pixelBytes, Stream data)
    {
        using var compressed = new ZLibStream(data, CompressionLevel.Optimal, leaveOpen: true);
        var stride = bytes.Length / height;
        var filter = new PngFilter(stride, pixelBytes);
        for (var y = 0; y < height; y++)
        {
            compressed.Write(filter.Apply(bytes.AsSpan(y * stride, stride)));
        }
    }

    /// <summary>Writes the chunk with the size and the format of an image.</summary>
    internal static void WriteHeader(int width, int height, PngChunkWriter chunks, int depth = 8)
    {
        Span<byte> header = stackalloc byte[HeaderBytes];
        BinaryPrimitives.WriteInt32BigEndian(header, width);
        BinaryPrimitives.WriteInt32BigEndian(header[4..], height);
        header[8] = (byte)depth;
        header[9] = Rgba;
        // The methods of compression and filtering, of which there is one each, and no interlacing.
        header[10..].Clear();
        chunks.Write(PngChunk.Header, header);
    }
}
