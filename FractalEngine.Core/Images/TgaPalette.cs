using System.Buffers.Binary;

namespace FractalEngine.Core.Images;

/// <summary>Tests the pixels of a TGA image with a palette: they are indices of its colours, of 8 bits.</summary>
/// <remarks>Source: Truevision TGA File Format Specification, version 2.0, colour-mapped images of types 1 and 9.</remarks>
internal static class TgaPalette
{
    private const int HeaderBytes = 18;
    private const int BufferBytes = 1 << 16;

    // A packet of the run-length encoding begins with a byte: whether one pixel is repeated, and the number of pixels less one.
    private const int IsRepeated = 0x80;

    /// <summary>Finds a pixel whose colour the palette lacks.</summary>
    /// <param name="stream">Seekable; afterwards anywhere. At least as long as the header says.</param>
    /// <param name="pixelCount">Pixels of the image.</param>
    /// <returns>The rest of a sentence that begins with the name of the image; null where there is none.</returns>
    /// <exception cref="IOException">The stream can't be read.</exception>
    public static string? FindFault(Stream stream, long pixelCount)
    {
        stream.Position = 0;
        Span<byte> header = stackalloc byte[HeaderBytes];
        stream.ReadExactly(header);
        var first = BinaryPrimitives.ReadUInt16LittleEndian(header[3..]);
        int colourCount = BinaryPrimitives.ReadUInt16LittleEndian(header[5..]);
        if (header[1] == 0 || colourCount == 0)
        {
            return "has no palette for its pixels";
        }

        if (first > 0)
        {
            return $"has a palette that begins with colour {first}, expected 0";
        }

        // Longer indices are left to the decoder, which refuses them.
        if (header[16] != 8)
        {
            return null;
        }

        stream.Position = HeaderBytes + header[0] + (colourCount * ((header[7] + 7) / 8));
        var max = header[2] == 1 ? FindMax(stream, pixelCount) : FindMaxOfPackets(new BufferedStream(stream, BufferBytes), pixelCount);
        return max < colourCount ? null : $"has a pixel of colour {max}, and a palette of {colourCount}";
    }

    private static int FindMax(Stream stream, long pixelCount)
    {
        var buffer = new byte[BufferBytes];
        var max = 0;
        while (pixelCount > 0 && stream.Read(buffer, 0, (int)Math.Min(pixelCount, buffer.Length)) is > 0 and var count)
        {
            foreach (var index in buffer.AsSpan(0, count))
            {
                max = Math.Max(max, index);
            }

            pixelCount -= count;
        }

        return max;
    }

    /// <summary>Reads packets until they have all pixels; where the file ends before, the decoder says so.</summary>
    private static int FindMaxOfPackets(Stream stream, long pixelCount)
    {
        var max = 0;
        while (pixelCount > 0 && stream.ReadByte() is >= 0 and var head)
        {
            var count = (head & ~IsRepeated) + 1;
            for (var i = (head & IsRepeated) == 0 ? count : 1; i > 0; i--)
            {
                max = Math.Max(max, stream.ReadByte());
            }

            pixelCount -= count;
        }

        return max;
    }
}
