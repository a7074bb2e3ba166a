using System.Buffers.Binary;
using System.IO.Compression;
using System.Text;

namespace FractalEngine.Core.Images;

/// <summary>Writes images of OpenEXR (<c>.exr</c>): scan lines of named channels, halves and floats, compressed by ZIP.</summary>
/// <remarks>After the format's own "OpenEXR File Layout". Primaries are those of Rec. 709, its default.</remarks>
public static class ExrWriter
{
    /// <summary>Largest number of bytes of a name.</summary>
    public const int MaxNameBytes = 31;

    private const int MagicNumber = 20000630;
    private const int Version = 2;

    // Rows that are compressed together.
    private const int BlockRows = 16;
    private const byte Zip = 3;

    private const int HalfType = 1;
    private const int FloatType = 2;

    /// <summary>Writes an image of at least one pixel.</summary>
    /// <param name="width">Pixels.</param>
    /// <param name="height">Pixels.</param>
    /// <param name="channels">At least one, each with a name of its own and as many numbers as there are pixels.</param>
    /// <param name="stream">Where to; left open. Need not seek.</param>
    /// <exception cref="ArgumentException">There is no pixel or channel, or one of another size or with a faulty name.</exception>
    /// <exception cref="IOException">The stream can't be written.</exception>
    /// <remarks>
    /// Numbers beyond the range of halves, 65504, become its ends; infinite ones stay infinite. Equal images give equal bytes on one
    /// version of .NET. Holds the compressed image, since its offsets stand before it.
    /// </remarks>
    public static void Write(int width, int height, IReadOnlyList<ImageChannel> channels, Stream stream)
    {
        ArgumentNullException.ThrowIfNull(channels);
        ArgumentNullException.ThrowIfNull(stream);
        var names = channels.Select(static channel => channel.Name).ToHashSet();
        if (width < 1 || height < 1 || channels.Count == 0 || names.Count < channels.Count
            || channels.Any(channel => channel.Values.LongLength != (long)width * height || !IsName(channel.Name)))
        {
            throw new ArgumentException(
                $"expected {width}×{height} numbers in each channel, and ASCII names of 1 to {MaxNameBytes} bytes", nameof(channels));
        }

        var sorted = channels.OrderBy(static channel => channel.Name, StringComparer.Ordinal).ToArray();
        var header = CreateHeader(width, height, sorted);
        var blocks = Enumerable.Range(0, (height + BlockRows - 1) / BlockRows).AsParallel().AsOrdered()
            .Select(block => Compress(Collect(block * BlockRows, Math.Min(BlockRows, height - (block * BlockRows)), width, sorted)))
            .ToArray();
        using var writer = new BinaryWriter(stream, Encoding.ASCII, leaveOpen: true);
        writer.Write(header);
        var offset = header.LongLength + (sizeof(long) * blocks.LongLength);
        foreach (var block in blocks)
        {
            writer.Write(offset);
            offset += (2 * sizeof(int)) + block.Length;
        }

        for (var i = 0; i < blocks.Length; i++)
        {
            writer.Write(i * BlockRows);
            writer.Write(blocks[i].Length);
            writer.Write(blocks[i]);
        }
    }

    private static bool IsName(string name) => name.Length is >= 1 and <= MaxNameBytes && name.All(static c => c is > ' ' and <= '~');

    private static byte[] CreateHeader(int width, int height, ImageChannel[] channels)
    {
        var memory = new MemoryStream();
        using var header = new BinaryWriter(memory, Encoding.ASCII);
        header.Write(MagicNumber);
        header.Write(Version);
        // A type, whether it is perceptually linear, and how many pixels apart its numbers are, across and down.
        Write("channels", "chlist", [.. channels.SelectMany(static channel => (byte[])
            [.. Text(channel.Name), .. Numbers(channel.IsHalf ? HalfType : FloatType, 0, 1, 1)]), 0]);
        Write("compression", "compression", [Zip]);
        Write("dataWindow", "box2i", Numbers(0, 0, width - 1, height - 1));
        Write("displayWindow", "box2i", Numbers(0, 0, width - 1, height - 1));
        // Rows from the top.
        Write("lineOrder", "lineOrder", [0]);
        var one = BitConverter.SingleToInt32Bits(1);
        Write("pixelAspectRatio", "float", Numbers(one));
        Write("screenWindowCenter", "v2f", Numbers(0, 0));
        Write("screenWindowWidth", "float", Numbers(one));
        header.Write((byte)0);
        return memory.ToArray();

        void Write(string name, string type, byte[] value)
        {
            header.Write(Text(name));
            header.Write(Text(type));
            header.Write(value.Length);
            header.Write(value);
        }
    }

    private static byte[] Text(string text) => [.. Encoding.ASCII.GetBytes(text), 0];

    private static byte[] Numbers(params ReadOnlySpan<int> numbers)
    {
        var bytes = new byte[sizeof(int) * numbers.Length];
        for (var i = 0; i < numbers.Length; i++)
        {
            BinaryPrimitives.WriteInt32LittleEndian(bytes.AsSpan(sizeof(int) * i), numbers[i]);
        }

        return bytes;
    }

    /// <summary>Collects the bytes of some rows: of each row, all numbers of one channel after the other.</summary>
    private static byte[] Collect(int top, int rows, int width, ImageChannel[] channels)
    {
        var bytes = new byte[rows * width * channels.Sum(static channel => channel.IsHalf ? 2 : 4)];
        var rest = bytes.AsSpan();
        for (var y = top; y < top + rows; y++)
        {
            foreach (var channel in channels)
            {
                foreach (var value in channel.Values.AsSpan(y * width, width))
                {
                    if (channel.IsHalf)
                    {
                        BinaryPrimitives.WriteHalfLittleEndian(rest, ToHalf(value));
                    }
                    else
                    {
                        BinaryPrimitives.WriteSingleLittleEndian(rest, value);
                    }

                    rest = rest[(channel.IsHalf ? 2 : 4)..];
                }
            }
        }

        return bytes;
    }

    // Bright light is no error: readers take infinite pixels for one.
    private static Half ToHalf(float value) =>
        float.IsFinite(value) ? (Half)Math.Clamp(value, (float)Half.MinValue, (float)Half.MaxValue) : (Half)value;

    /// <summary>Compresses a block: first bytes of numbers, then last ones, each as the difference from the one before.</summary>
    private static byte[] Compress(byte[] bytes)
    {
        var sorted = new byte[bytes.Length];
        var middle = (bytes.Length + 1) / 2;
        for (var i = 0; i < bytes.Length; i++)
        {
            sorted[(i / 2) + ((i & 1) * middle)] = bytes[i];
        }

        for (var i = sorted.Length - 1; i > 0; i--)
        {
            sorted[i] = (byte)(sorted[i] - sorted[i - 1] + 128);
        }

        var memory = new MemoryStream();
        using (var compressed = new ZLibStream(memory, CompressionLevel.Optimal, leaveOpen: true))
        {
            compressed.Write(sorted);
        }

        // Readers tell by the length what did not become smaller, and is stored as it was.
        return memory.Length < bytes.Length ? memory.ToArray() : bytes;
    }
}
