using System.IO.Compression;
using FractalEngine.Render.Images;
using static FractalEngine.Tests.Images.PlainPng;

namespace FractalEngine.Tests.Render.Images;

/// <summary>Images that are damaged or of kinds that are not read, and the whole message of each.</summary>
public class DamagedImageTests
{
    private const string NoImage = "it is not a PNG, JPEG, BMP or TGA image";
    private const string Undecodable = "it is damaged, or of a kind that can't be decoded: ";

    private static readonly byte[] End = Chunk("IEND");

    // Two pixels of grey in one row.
    private static readonly byte[] Grey = Header(2, 1, 8, 0);
    private static readonly byte[] Pixels = Data([0, 10, 20]);

    // Two indices, and a palette for them.
    private static readonly byte[] Indexed = Header(2, 1, 8, 3);
    private static readonly byte[] OneColour = Chunk("PLTE", 1, 2, 3);

    // The signature and IHDR take 33 bytes.
    public static TheoryData<string, string, byte[]> Broken => new()
    {
        { "empty", NoImage, [] },
        { "text", NoImage, [.. "no picture"u8] },
        { "signature alone", NoImage, Signature },
        { "other chunk first", NoImage, [.. Signature, .. Pixels, .. Grey] },
        { "header alone", "byte 33: the file ends before the chunk IEND", File(Grey) },
        { "no width", $"{Undecodable}0-pixel image", File(Header(0, 1, 8, 0), Pixels, End) },
        {
            "negative height", "an image of 1×4294967295 pixels, more than the limit of 134217728 in all",
            File(Header(1, -1, 8, 0), Pixels, End)
        },
        { "large", "an image of 12000×12000 pixels, more than the limit of 134217728 in all", File(Header(12_000, 12_000, 1, 0)) },
        { "cut off", "it is cut off: 9000×9000 pixels need at least 78488 bytes, and it has 33", File(Header(9_000, 9_000, 8, 0)) },
        { "colour type 1", $"{Undecodable}bad ctype", File(Header(2, 1, 8, 1), Pixels, End) },
        { "depth 3", $"{Undecodable}1/2/4/8/16-bit only", File(Header(2, 1, 3, 0), Pixels, End) },
        { "palette of 16 bits", $"{Undecodable}bad ctype", File(Header(2, 1, 16, 3), Pixels, End) },
        { "compression", $"{Undecodable}bad comp method", File(Header(2, 1, 8, 0, compression: 1), Pixels, End) },
        { "filtering", $"{Undecodable}bad filter method", File(Header(2, 1, 8, 0, filter: 64), Pixels, End) },
        { "interlacing", $"{Undecodable}bad interlace method", File(Header(2, 1, 8, 0, interlace: 2), Pixels, End) },
        { "second header", $"{Undecodable}multiple IHDR", File(Grey, Grey, Pixels, End) },
        { "no pixels", $"{Undecodable}no IDAT", File(Grey, End) },
        { "no end", "byte 56: the file ends before the chunk IEND", File(Grey, Pixels) },
        { "CRC of the header", "byte 8: the CRC of this chunk does not match", Damage(File(Grey, Pixels, End), 32) },
        {
            "CRC of the transparency", "byte 33: the CRC of this chunk does not match",
            Damage(File(Grey, Chunk("tRNS", 0, 1), Pixels, End), 42)
        },
        { "CRC of the palette", "byte 33: the CRC of this chunk does not match", Damage(File(Indexed, OneColour, Pixels, End), 44) },
        { "CRC of the pixels", "byte 33: the CRC of this chunk does not match", Damage(File(Grey, Pixels, End), 52) },
        { "CRC of the end", "byte 56: the CRC of this chunk does not match", Damage(File(Grey, Pixels, End), 67) },
        { "endless chunk", "byte 49: the file ends before the chunk IEND", File(Grey, [0x80, 0, 0, 0, .. "tEXt"u8, .. new byte[8]]) },
        {
            "chunk of a negative length", "byte 49: the file ends before the chunk IEND",
            File(Grey, [255, 255, 255, 244, .. "tEXt"u8, .. new byte[8]])
        },
        { "long chunk", "byte 49: the file ends before the chunk IEND", File(Grey, [0x3F, 255, 255, 255, .. "IDAT"u8, .. new byte[8]]) },
        { "unknown chunk", $"{Undecodable}ABCD", File(Grey, Chunk("ABCD"), Pixels, End) },
        { "no palette", $"{Undecodable}no PLTE", File(Indexed, Pixels, End) },
        { "palette of 4 bytes", $"{Undecodable}invalid PLTE", File(Indexed, Chunk("PLTE", 1, 2, 3, 4), Pixels, End) },
        { "long palette", $"{Undecodable}invalid PLTE", File(Indexed, Chunk("PLTE", new byte[771]), Pixels, End) },
        { "alpha before colours", $"{Undecodable}tRNS before PLTE", File(Indexed, Chunk("tRNS", 1), OneColour, Pixels, End) },
        { "more alphas than colours", $"{Undecodable}bad tRNS len", File(Indexed, OneColour, Chunk("tRNS", 1, 2), Pixels, End) },
        { "short tRNS", $"{Undecodable}bad tRNS len", File(Grey, Chunk("tRNS", 1), Pixels, End) },
        { "late tRNS", $"{Undecodable}tRNS after IDAT", File(Grey, Pixels, Chunk("tRNS", 0, 1), End) },
        { "alpha twice", $"{Undecodable}tRNS with alpha", File(Header(1, 1, 8, 4), Chunk("tRNS", 0, 1), Pixels, End) },
        { "few pixels", $"{Undecodable}not enough pixels", File(Grey, Data([0, 10]), End) },
        { "empty data", $"{Undecodable}wrong data", File(Grey, Chunk("IDAT"), Pixels, End) },
        { "no zlib", "the compressed pixels are damaged", File(Grey, Chunk("IDAT", 1, 2, 3, 4, 5, 6, 7), End) },
        { "block type 3", "the compressed pixels are damaged", File(Grey, Chunk("IDAT", 0x78, 1, 7, 0), End) },
        {
            "checksum of zlib", "the compressed pixels are damaged",
            File(Grey, Chunk("IDAT", 0x78, 1, 1, 3, 0, 252, 255, 0, 10, 20, 0, 0, 0, 0), End)
        },
        { "filter 5", $"{Undecodable}invalid filter", File(Grey, Data([5, 10, 20]), End) },
        { "cut JPEG", $"{Undecodable}the file ends within it", ImageDecoderTests.Jpeg[..^2] },
        { "JPEG with arithmetic coding", $"{Undecodable}unknown marker", WithMarker(0xC0, 0xC9) },
        { "JPEG that ends with a wrong marker", $"{Undecodable}unknown marker", WithMarker(0xD9, 0xC9) },
        { "JPEG with a wrong marker before its pixels", $"{Undecodable}unknown marker", WithMarker(0xDA, 0xC9) },
        {
            "run-length encoded BMP", $"{Undecodable}BMP RLE",
            [.. "BM"u8, 62, 0, 0, 0, 0, 0, 0, 0, 54, 0, 0, 0, 40, 0, 0, 0, 2, 0, 0, 0, 1, 0, 0, 0, 1, 0, 8, 0, 1, .. new byte[31]]
        },
    };

    [Theory]
    [MemberData(nameof(Broken))]
    public void Load_OfABrokenFile_SaysWhy(string name, string message, byte[] file)
    {
        var error = Assert.Throws<IOException>(() => ImageFile.Load(new MemoryStream(file), isTga: false));
        Assert.Equal((name, message), (name, error.Message));
    }

    [Fact]
    public void Load_OfATgaThatEndsWithinAPacket_SaysSo()
    {
        byte[] file = [0, 0, 10, 0, 0, 0, 0, 0, 0, 0, 0, 0, 2, 0, 1, 0, 24, 0, 1, 1, 2, 3, 4, 5];
        var error = Assert.Throws<IOException>(() => ImageFile.Load(new MemoryStream(file), isTga: true));
        Assert.Equal($"{Undecodable}the file ends within it", error.Message);
    }

    [Fact]
    public void Load_OfDataBeyondTheLastPixel_IgnoresIt()
    {
        var more = Data([0, 10, 20, 99, 99, 99]);
        AssertGrey(File(Grey, more, Chunk("IDAT", 1, 2, 3), End));
    }

    [Fact]
    public void Load_OfADamagedChunkThatIsNotUsed_IgnoresIt() => AssertGrey(Damage(File(Grey, Chunk("iCCP", 1, 2, 3), Pixels, End), 41));

    [Fact]
    public void Load_OfACutChecksumOfPixels_IgnoresIt() =>
        // The CRC of the chunk has its own.
        AssertGrey(File(Grey, Chunk("IDAT", 0x78, 1, 1, 3, 0, 252, 255, 0, 10, 20, 0), End));

    [Fact]
    public void Load_OfBytesBehindTheImage_IgnoresThem() => AssertGrey([.. File(Grey, Pixels, End), 1, 2, 3]);

    private static void AssertGrey(byte[] file) =>
        Assert.Equal([10, 10, 10, 255, 20, 20, 20, 255], ImageFile.Load(new MemoryStream(file), isTga: false).Pixels);

    private static byte[] WithMarker(byte from, byte to)
    {
        var jpeg = ImageDecoderTests.Jpeg;
        jpeg[jpeg.AsSpan().LastIndexOf((ReadOnlySpan<byte>)[0xFF, from]) + 1] = to;
        return jpeg;
    }

    private static byte[] File(params byte[][] chunks) => [.. Signature, .. chunks.SelectMany(chunk => chunk)];

    private static byte[] Header(int width, int height, byte depth, byte type, byte compression = 0, byte filter = 0, byte interlace = 0) =>
        Chunk("IHDR", [.. BigEndian(width), .. BigEndian(height), depth, type, compression, filter, interlace]);

    private static byte[] Data(byte[] rows)
    {
        using var output = new MemoryStream();
        using (var stream = new ZLibStream(output, CompressionLevel.Optimal, leaveOpen: true))
        {
            stream.Write(rows);
        }

        return Chunk("IDAT", output.ToArray());
    }

    private static byte[] Damage(byte[] file, int offset)
    {
        file[offset] ^= 1;
        return file;
    }
}
