using System.Buffers.Binary;
using System.IO.Compression;
using System.Text;

namespace FractalEngine.Tests.Images;

/// <summary>
/// Reads scan lines of OpenEXR from the layout of the format, a byte at a time. It is the oracle of what is written, and shares no code
/// with what it judges.
/// </summary>
internal sealed class PlainExr
{
    private readonly byte[] _file;
    private readonly Dictionary<string, byte[]> _attributes = [];

    public PlainExr(byte[] file)
    {
        _file = file;
        Assert.Equal(20000630, Int(0));
        Assert.Equal(2, Int(4));
        var place = 8;
        while (file[place] != 0)
        {
            var name = Name(file, ref place);
            _attributes[$"{name}:{Name(file, ref place)}"] = file[(place + 4)..(place + 4 + Int(place))];
            place += 4 + Int(place);
        }

        place++;
        var window = Attribute("dataWindow:box2i");
        Assert.Equal(window, Attribute("displayWindow:box2i"));
        Assert.Equal([0, 0], Ints(window)[..2]);
        (Width, Height) = (Ints(window)[2] + 1, Ints(window)[3] + 1);
        Assert.Equal([3], Attribute("compression:compression"));
        Assert.Equal([0], Attribute("lineOrder:lineOrder"));
        Assert.Equal(1f, BitConverter.ToSingle(Attribute("pixelAspectRatio:float")));
        Assert.Equal(new byte[8], Attribute("screenWindowCenter:v2f"));
        Assert.Equal(1f, BitConverter.ToSingle(Attribute("screenWindowWidth:float")));
        ReadChannels();
        ReadBlocks(place);
    }

    public int Width { get; }

    public int Height { get; }

    /// <summary>The channels in the order of the file: name, whether its numbers are halves, and the numbers.</summary>
    public List<(string Name, bool IsHalf, float[] Values)> Channels { get; } = [];

    /// <summary>The numbers of a channel.</summary>
    public float[] this[string name] => Channels.Single(channel => channel.Name == name).Values;

    private byte[] Attribute(string name) => _attributes[name];

    private int Int(int place) => BinaryPrimitives.ReadInt32LittleEndian(_file.AsSpan(place));

    private static int[] Ints(byte[] bytes) => [.. bytes.Chunk(4).Select(four => BitConverter.ToInt32(four))];

    private static string Name(byte[] bytes, ref int place)
    {
        var start = place;
        while (bytes[place++] != 0)
        {
        }

        return Encoding.ASCII.GetString(bytes, start, place - 1 - start);
    }

    private void ReadChannels()
    {
        var list = Attribute("channels:chlist");
        for (var place = 0; list[place] != 0;)
        {
            var name = Name(list, ref place);
            var fields = Ints(list[place..(place + 16)]);
            Assert.Equal([0, 1, 1], fields[1..]);
            Assert.InRange(fields[0], 1, 2);
            Channels.Add((name, fields[0] == 1, new float[Width * Height]));
            place += 16;
        }
    }

    private void ReadBlocks(int table)
    {
        var end = table + (8 * ((Height + 15) / 16));
        for (var y = 0; y < Height; y += 16)
        {
            var start = (int)BinaryPrimitives.ReadInt64LittleEndian(_file.AsSpan(table + (y / 16 * 8)));
            Assert.Equal(end, start);
            Assert.Equal(y, Int(start));
            end = start + 8 + Int(start + 4);
            var rows = Math.Min(16, Height - y);
            var block = Unpack(_file[(start + 8)..end], rows * Width * Channels.Sum(channel => channel.IsHalf ? 2 : 4));
            var place = 0;
            for (var row = y; row < y + rows; row++)
            {
                foreach (var (_, isHalf, values) in Channels)
                {
                    for (var x = 0; x < Width; x++)
                    {
                        values[(row * Width) + x] = isHalf ? (float)BitConverter.ToHalf(block, place) : BitConverter.ToSingle(block, place);
                        place += isHalf ? 2 : 4;
                    }
                }
            }
        }

        Assert.Equal(_file.Length, end);
    }

    private static byte[] Unpack(byte[] data, int length)
    {
        if (data.Length == length)
        {
            return data;
        }

        using var stream = new ZLibStream(new MemoryStream(data), CompressionMode.Decompress);
        var unpacked = new MemoryStream();
        stream.CopyTo(unpacked);
        var differences = unpacked.ToArray();
        Assert.Equal(length, differences.Length);
        for (var i = 1; i < length; i++)
        {
            differences[i] = (byte)(differences[i - 1] + differences[i] - 128);
        }

        var bytes = new byte[length];
        var (first, second) = (0, (length + 1) / 2);
        for (var i = 0; i < length; i++)
        {
            bytes[i] = differences[i % 2 == 0 ? first++ : second++];
        }

        return bytes;
    }
}
