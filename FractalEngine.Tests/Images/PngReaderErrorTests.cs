using System.IO.Compression;
using FractalEngine.Core.Images;
using static FractalEngine.Tests.Images.PlainPng;

namespace FractalEngine.Tests.Images;

/// <summary>What breaks the standard, and the whole message of it.</summary>
public class PngReaderErrorTests
{
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
        { "empty", "byte 0: no PNG signature", [] },
        { "text", "byte 0: no PNG signature", [.. "no picture"u8] },
        { "signature alone", "byte 8: the file ends before the chunk IEND", Signature },
        { "other chunk first", "byte 8: the chunk IDAT of 11 bytes, expected IHDR of 13", [.. Signature, .. Pixels, .. Grey] },
        {
            "long header", "byte 8: the chunk IHDR of 14 bytes, expected IHDR of 13",
            [.. Signature, .. Chunk("IHDR", new byte[14])]
        },
        { "no width", "byte 16: an image of 0×1 pixels, expected 1 to 2147483647 a side", File(Header(0, 1, 8, 0)) },
        { "negative height", "byte 16: an image of 1×4294967295 pixels, expected 1 to 2147483647 a side", File(Header(1, -1, 8, 0)) },
        { "colour type 1", "byte 25: colour type 1, expected 0, 2, 3, 4 or 6", File(Header(1, 1, 8, 1)) },
        { "depth 3", "byte 24: colour type 0 with 3 bits, which the standard does not allow", File(Header(1, 1, 3, 0)) },
        { "palette of 16 bits", "byte 24: colour type 3 with 16 bits, which the standard does not allow", File(Header(1, 1, 16, 3)) },
        { "RGB of 4 bits", "byte 24: colour type 2 with 4 bits, which the standard does not allow", File(Header(1, 1, 4, 2)) },
        { "compression", "byte 26: compression method 1, expected 0", File(Header(1, 1, 8, 0, compression: 1)) },
        { "filtering", "byte 27: filter method 64, expected 0", File(Header(1, 1, 8, 0, filter: 64)) },
        { "interlacing", "byte 28: interlace method 2, expected 0 or 1", File(Header(1, 1, 8, 0, interlace: 2)) },
        { "wide", "byte 16: an image of 1000001×1 pixels, more than the limit of 1000000 a side", File(Header(1_000_001, 1, 1, 0)) },
        { "large", "byte 16: an image of 12000×12000 pixels, more than the limit of 134217728 in all", File(Header(12_000, 12_000, 1, 0)) },
        { "second header", "byte 33: a second IHDR", File(Grey, Grey, Pixels, End) },
        { "no pixels", "byte 33: the image has no pixels (IDAT)", File(Grey, End) },
        { "no end", "byte 56: the file ends before the chunk IEND", File(Grey, Pixels) },
        { "end with data", "byte 56: the chunk IEND is not empty", File(Grey, Pixels, Chunk("IEND", 1)) },
        { "CRC of the header", "byte 29: the CRC of the chunk IHDR does not match", Damage(File(Grey, Pixels, End), 32) },
        {
            "CRC of the transparency", "byte 43: the CRC of the chunk tRNS does not match",
            Damage(File(Grey, Chunk("tRNS", 0, 1), Pixels, End), 42)
        },
        { "CRC of the palette", "byte 44: the CRC of the chunk PLTE does not match", Damage(File(Indexed, OneColour, Pixels, End), 44) },
        { "CRC of the pixels", "byte 52: the CRC of the chunk IDAT does not match", Damage(File(Grey, Pixels, End), 52) },
        { "CRC of the end", "byte 64: the CRC of the chunk IEND does not match", Damage(File(Grey, Pixels, End), 67) },
        { "no letters", "byte 37: 0x30444154 is no chunk type", File(Grey, Chunk("0DAT"), End) },
        { "endless chunk", "byte 33: the length of tEXt is beyond 2147483647 bytes", File(Grey, [0x80, 0, 0, 0, .. "tEXt"u8]) },
        { "long chunk", "byte 41: the file ends within the chunk tEXt", File(Grey, [0x7F, 255, 255, 255, .. "tEXt"u8]) },
        {
            "unknown chunk", "byte 33: the unknown chunk ABCD, without which the image can't be read",
            File(Grey, Chunk("ABCD"), Pixels, End)
        },
        { "two groups of pixels", "byte 68: a chunk IDAT apart from the others", File(Grey, Pixels, Chunk("tEXt"), Pixels, End) },
        { "no palette", "byte 33: the pixels come before their palette (PLTE)", File(Indexed, Pixels, End) },
        { "palette of grey", "byte 33: a palette (PLTE) in an image of grey", File(Grey, OneColour, Pixels, End) },
        {
            "palette of 4 bytes", "byte 33: a palette (PLTE) of 4 bytes, expected 3 for each of 1 to 256 colours",
            File(Indexed, Chunk("PLTE", 1, 2, 3, 4))
        },
        { "empty palette", "byte 33: a palette (PLTE) of 0 bytes, expected 3 for each of 1 to 256 colours", File(Indexed, Chunk("PLTE")) },
        {
            "long palette", "byte 33: a palette (PLTE) of 771 bytes, expected 3 for each of 1 to 256 colours",
            File(Indexed, Chunk("PLTE", new byte[771]))
        },
        { "two palettes", "byte 48: a second palette (PLTE)", File(Indexed, OneColour, OneColour) },
        { "late palette", "byte 56: PLTE stands after the pixels", File(Header(2, 1, 8, 0), Pixels, OneColour, End) },
        { "index beyond the palette", "byte 67: a pixel's colour is beyond the palette", File(Indexed, OneColour, Data([0, 0, 1]), End) },
        { "alpha before colours", "byte 33: tRNS stands before the palette (PLTE)", File(Indexed, Chunk("tRNS", 1)) },
        {
            "more alphas than colours", "byte 48: a tRNS of 2 bytes, expected at most one for each of 1 colours",
            File(Indexed, OneColour, Chunk("tRNS", 1, 2))
        },
        {
            "palette after tRNS", "byte 51: the palette (PLTE) stands after tRNS",
            File(Header(2, 1, 8, 2), Chunk("tRNS", 0, 1, 0, 2, 0, 3), OneColour)
        },
        { "short tRNS", "byte 33: a tRNS of 1 bytes, expected 2", File(Grey, Chunk("tRNS", 1)) },
        { "tRNS of RGB", "byte 33: a tRNS of 2 bytes, expected 6", File(Header(2, 1, 8, 2), Chunk("tRNS", 0, 1)) },
        { "two tRNS", "byte 47: a second tRNS", File(Grey, Chunk("tRNS", 0, 1), Chunk("tRNS", 0, 1), Pixels, End) },
        { "late tRNS", "byte 56: tRNS stands after the pixels", File(Grey, Pixels, Chunk("tRNS", 0, 1), End) },
        { "few pixels", "byte 51: the compressed pixels end early: the image has 2×1", File(Grey, Data([0, 10]), End) },
        { "no data", "byte 53: the compressed pixels end early: the image has 2×1", File(Grey, Chunk("IDAT"), End) },
        {
            "no zlib", "byte 41: the compressed pixels begin with 0x0102, which PNG does not allow",
            File(Grey, Chunk("IDAT", 1, 2, 3, 4, 5, 6, 7), End)
        },
        {
            "dictionary", "byte 41: the compressed pixels begin with 0x7820, which PNG does not allow",
            File(Grey, Chunk("IDAT", 0x78, 0x20, 1, 2, 3, 4, 5), End)
        },
        { "block type 3", "byte 45: the compressed pixels are damaged", File(Grey, Chunk("IDAT", 0x78, 1, 7, 0), End) },
        {
            "checksum of zlib", "byte 55: the compressed pixels are damaged",
            File(Grey, Chunk("IDAT", 0x78, 1, 1, 3, 0, 252, 255, 0, 10, 20, 0, 0, 0, 0), End)
        },
        { "filter 5", "byte 52: filter type 5, expected 0 to 4", File(Grey, Data([5, 10, 20]), End) },
    };

    [Theory]
    [MemberData(nameof(Broken))]
    public void Read_OfABrokenFile_SaysWhereAndWhy(string name, string message, byte[] file)
    {
        var error = Assert.Throws<PngException>(() => PngReader.Read(new MemoryStream(file)));
        Assert.Equal((name, message), (name, error.Message));
        Assert.StartsWith(FormattableString.Invariant($"byte {error.Offset}: "), message, StringComparison.Ordinal);
    }

    [Fact]
    public void Read_OfMorePixelsThanTheCallerAllows_IsRefused()
    {
        var file = File(Grey, Pixels, End);
        Assert.Equal([10, 10, 10, 255, 20, 20, 20, 255], PngReader.Read(new MemoryStream(file), 2).Pixels);
        var error = Assert.Throws<PngException>(() => PngReader.Read(new MemoryStream(file), 1));
        Assert.Equal("byte 16: an image of 2×1 pixels, more than the limit of 1 in all", error.Message);
    }

    [Fact]
    public void Read_OfDataBeyondTheLastPixel_IgnoresIt()
    {
        var more = Data([0, 10, 20, 99, 99, 99]);
        var file = File(Grey, more, Chunk("IDAT", 1, 2, 3), End);
        Assert.Equal([10, 10, 10, 255, 20, 20, 20, 255], PngReader.Read(new MemoryStream(file)).Pixels);
    }

    [Fact]
    public void Read_OfADamagedChunkThatIsNotUsed_IgnoresIt()
    {
        var file = Damage(File(Grey, Chunk("iCCP", 1, 2, 3), Pixels, End), 41);
        Assert.Equal([10, 10, 10, 255, 20, 20, 20, 255], PngReader.Read(new MemoryStream(file)).Pixels);
    }

    [Fact]
    public void Read_OfACutChecksumOfPixels_IgnoresIt()
    {
        // The CRC of the chunk has its own.
        var cut = Chunk("IDAT", 0x78, 1, 1, 3, 0, 252, 255, 0, 10, 20, 0);
        Assert.Equal([10, 10, 10, 255, 20, 20, 20, 255], PngReader.Read(new MemoryStream(File(Grey, cut, End))).Pixels);
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
