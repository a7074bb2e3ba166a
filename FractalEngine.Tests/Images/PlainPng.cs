using System.IO.Compression;
using System.Text;

namespace FractalEngine.Tests.Images;

/// <summary>
/// Writes PNG files of every kind that the standard knows, bit by bit as its sections say. It is the oracle of what is read
/// and written, and shares no code with what it judges.
/// </summary>
internal static class PlainPng
{
    public static readonly byte[] Signature = [137, 80, 78, 71, 13, 10, 26, 10];

    /// <summary>A whole file.</summary>
    /// <param name="samples">Of an image.</param>
    /// <param name="random">Draws the filters, the sizes of chunks and the way to compress.</param>
    /// <param name="filter">Of all rows; drawn for each row if null.</param>
    public static byte[] Encode(PlainSamples samples, Random random, int? filter = null)
    {
        var data = Compress(Filtered(samples, random, filter), random);
        return [.. Signature, .. Head(samples), .. Split(data, random), .. Chunk("IEND")];
    }

    /// <summary>The chunks before the pixels.</summary>
    public static byte[] Head(PlainSamples samples)
    {
        var header = Chunk("IHDR",
        [
            .. BigEndian(samples.Width), .. BigEndian(samples.Height), (byte)samples.Depth, (byte)samples.ColourType,
            0, 0, (byte)(samples.IsInterlaced ? 1 : 0),
        ]);
        var palette = samples.Palette is null ? [] : Chunk("PLTE", samples.Palette);
        var transparency = samples.Transparency is null ? [] : Chunk("tRNS", samples.Transparency);
        return [.. header, .. palette, .. transparency];
    }

    /// <summary>One chunk with its length and CRC.</summary>
    public static byte[] Chunk(string type, params byte[] data)
    {
        byte[] body = [.. Encoding.ASCII.GetBytes(type), .. data];
        return [.. BigEndian(data.Length), .. body, .. BigEndian((int)Crc(body))];
    }

    /// <summary>The bytes before compression: rows of all passes, each with its filter.</summary>
    public static byte[] Filtered(PlainSamples samples, Random random, int? filter = null)
    {
        var bytes = new List<byte>();
        foreach (var (left, top, stepX, stepY) in samples.IsInterlaced ? Adam7 : [(0, 0, 1, 1)])
        {
            byte[]? above = null;
            for (var y = top; y < samples.Height && left < samples.Width; y += stepY)
            {
                var row = Pack(samples, left, stepX, y);
                var type = filter ?? random.Next(5);
                bytes.Add((byte)type);
                bytes.AddRange(Filter(row, above ?? new byte[row.Length], type, (samples.Channels * samples.Depth + 7) / 8));
                above = row;
            }
        }

        return [.. bytes];
    }

    /// <summary>zlib's format, from the framework or stored as it is.</summary>
    public static byte[] Compress(byte[] bytes, Random random)
    {
        if (random.Next(3) == 0)
        {
            return Store(bytes);
        }

        var output = new MemoryStream();
        using (var stream = new ZLibStream(output, (CompressionLevel)random.Next(4)))
        {
            stream.Write(bytes);
        }

        return output.ToArray();
    }

    /// <summary>The pixels as <c>IDAT</c> chunks of random lengths.</summary>
    public static byte[] Split(byte[] data, Random random)
    {
        var chunks = new List<byte>();
        for (var start = 0; start < data.Length;)
        {
            var count = random.Next(4) == 0 ? random.Next(1, 3) : random.Next(1, 2 * data.Length);
            count = Math.Min(count, data.Length - start);
            chunks.AddRange(Chunk("IDAT", data[start..(start + count)]));
            start += count;
        }

        return [.. chunks];
    }

    /// <summary>CRC-32, a bit at a time.</summary>
    public static uint Crc(ReadOnlySpan<byte> bytes)
    {
        var crc = uint.MaxValue;
        foreach (var value in bytes)
        {
            crc ^= value;
            for (var bit = 0; bit < 8; bit++)
            {
                crc = (crc & 1) == 1 ? (crc >> 1) ^ 0xEDB88320 : crc >> 1;
            }
        }

        return ~crc;
    }

    public static byte[] BigEndian(int value) => [(byte)(value >> 24), (byte)(value >> 16), (byte)(value >> 8), (byte)value];

    /// <summary>Blocks of type 0 (RFC 1951, §3.2.4) with the head and checksum of RFC 1950.</summary>
    private static byte[] Store(byte[] bytes)
    {
        const int MaxBlockBytes = 1000;
        var output = new List<byte> { 0x78, 0x01 };
        for (var start = 0; start < bytes.Length; start += MaxBlockBytes)
        {
            var block = bytes[start..Math.Min(bytes.Length, start + MaxBlockBytes)];
            var low = (byte)block.Length;
            var high = (byte)(block.Length >> 8);
            output.AddRange([(byte)(start + MaxBlockBytes >= bytes.Length ? 1 : 0), low, high, (byte)~low, (byte)~high, .. block]);
        }

        var a = 1;
        var b = 0;
        foreach (var value in bytes)
        {
            a = (a + value) % 65521;
            b = (b + a) % 65521;
        }

        return [.. output, .. BigEndian((b << 16) | a)];
    }

    private static byte[] Pack(PlainSamples samples, int left, int stepX, int y)
    {
        var bits = new List<bool>();
        for (var x = left; x < samples.Width; x += stepX)
        {
            foreach (var sample in samples.Pixel(x, y))
            {
                for (var bit = samples.Depth - 1; bit >= 0; bit--)
                {
                    bits.Add(((sample >> bit) & 1) == 1);
                }
            }
        }

        var bytes = new byte[(bits.Count + 7) / 8];
        for (var i = 0; i < bits.Count; i++)
        {
            bytes[i / 8] |= (byte)(bits[i] ? 0x80 >> (i % 8) : 0);
        }

        return bytes;
    }

    private static IEnumerable<byte> Filter(byte[] row, byte[] above, int type, int distance)
    {
        for (var i = 0; i < row.Length; i++)
        {
            var a = i >= distance ? row[i - distance] : 0;
            var b = above[i];
            var c = i >= distance ? above[i - distance] : 0;
            yield return (byte)(row[i] - type switch
            {
                0 => 0,
                1 => a,
                2 => b,
                3 => (a + b) / 2,
                _ => Paeth(a, b, c),
            });
        }
    }

    private static int Paeth(int a, int b, int c)
    {
        var p = a + b - c;
        var pa = Math.Abs(p - a);
        var pb = Math.Abs(p - b);
        var pc = Math.Abs(p - c);
        return pa <= pb && pa <= pc ? a : pb <= pc ? b : c;
    }

    private static readonly (int Left, int Top, int StepX, int StepY)[] Adam7 =
        [(0, 0, 8, 8), (4, 0, 8, 8), (0, 4, 4, 8), (2, 0, 4, 4), (0, 2, 2, 4), (1, 0, 2, 2), (0, 1, 1, 2)];
}
