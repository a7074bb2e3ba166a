using System.Text;
using FractalEngine.Parsing.Text;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Parsing.Text;

public sealed class SourceTextTests : IDisposable
{
    private readonly TemporaryFolder _folder = new();

    public void Dispose() => _folder.Dispose();

    [Fact]
    public void Read_OfUtf8_IsTheText() => Assert.Equal("größer 🌲\n", Read(Encoding.UTF8.GetBytes("größer 🌲\n")).Text);

    [Fact]
    public void Read_WithAByteOrderMark_OmitsIt() => Assert.Equal("c", Read([0xEF, 0xBB, 0xBF, (byte)'c']).Text);

    [Fact]
    public void ByteCount_OfAFile_IncludesItsByteOrderMark()
    {
        Assert.Equal(4, Read([0xEF, 0xBB, 0xBF, (byte)'c']).ByteCount);
        Assert.Equal(0, new SourceText("f", "not from a file").ByteCount);
    }

    [Theory]
    [InlineData("", "\n")]
    [InlineData("a\nb\r", "\n")]
    [InlineData("a\nb\r\n", "\r\n")]
    public void LineBreak_OfAText_IsTheOneOfWindowsIfItOccurs(string text, string expected) =>
        Assert.Equal(expected, new SourceText("f", text).LineBreak);

    [Theory]
    [InlineData(0, 1)]
    [InlineData(3, 1)]
    [InlineData(5, 2)]
    [InlineData(7, 3)]
    [InlineData(99, 3)]
    public void LineOf_AnOffset_IsTheLineOfItsDiagnostic(int offset, int line)
    {
        var source = new SourceText("f", "one\r\n\r\nthree");
        Assert.Equal(line, source.LineOf(offset));
        Assert.Equal(line, source.Diagnose(offset, "m").Line);
    }

    [Fact]
    public void Read_OfAnEmptyFile_IsEmpty() => Assert.Equal("", Read([]).Text);

    [Theory]
    [InlineData(false)]
    [InlineData(true)]
    public void Read_OfUtf16_DecodesIt(bool bigEndian)
    {
        var source = Read(Utf16("# Größe \u4E00 \U0001F600\r\nv 1 2 3", bigEndian));
        Assert.Equal(("# Größe \u4E00 \U0001F600\r\nv 1 2 3", 44), (source.Text, source.ByteCount));
    }

    [Theory]
    [InlineData(false)]
    [InlineData(true)]
    public void Read_OfFaultyUtf16_IsRefusedOrReplaced(bool bigEndian)
    {
        byte[] half = [.. Utf16("ab", bigEndian), 0x20];
        Errors.AssertMessage("named:1:1: error: the file has a character that is no UTF-16 text", () => Read(half));
        Assert.Equal("ab\uFFFD", Read(half, acceptLatin1: true).Text);
    }

    [Fact]
    public void Read_OfUtf16WithANul_IsRefusedAtIt() => Errors.AssertMessage(
        "named:2:2: error: the file is binary (it has a NUL byte), expected UTF-8 text", () => Read(Utf16("a\nb\0", false)));

    private static byte[] Utf16(string text, bool bigEndian)
    {
        var encoding = new UnicodeEncoding(bigEndian, byteOrderMark: true);
        return [.. encoding.GetPreamble(), .. encoding.GetBytes(text)];
    }

    [Fact]
    public void Read_OfUtf16WithoutAMark_IsRefusedAtItsFirstNul()
    {
        var error = Errors.ThrownBy(() => Read(Encoding.Unicode.GetBytes("v 1 2 3\n"))).Diagnostic;
        Assert.Equal((1, 2), (error.Line, error.Column));
        Assert.Contains("binary", error.Message, StringComparison.Ordinal);
    }

    [Theory]
    [InlineData(false)]
    [InlineData(true)]
    public void Read_OfABinaryFile_IsRefusedInEveryEncoding(bool acceptLatin1) =>
        Assert.Contains(": error: the file is binary",
        Errors.MessageOf(() => Read([0x89, (byte)'P', (byte)'N', (byte)'G', 13, 10, 26, 10, 0, 0, 0, 13], acceptLatin1)),
        StringComparison.Ordinal);

    [Fact]
    public void Read_OfLatin1_IsRefusedAtItsPosition()
    {
        var error = Errors.ThrownBy(() => Read(Encoding.Latin1.GetBytes("# one\n# two\n# Größe\n"))).Diagnostic;
        Assert.Equal((3, 5), (error.Line, error.Column));
        Assert.Contains("UTF-8", error.Message, StringComparison.Ordinal);
    }

    [Fact]
    public void Read_OfLatin1WhereAccepted_IsTheText() =>
        Assert.Equal("# Größe", Read(Encoding.Latin1.GetBytes("# Größe"), acceptLatin1: true).Text);

    [Fact]
    public void Read_OfUtf8WhereLatin1IsAccepted_IsStillUtf8() =>
        Assert.Equal("# Größe", Read(Encoding.UTF8.GetBytes("# Größe"), acceptLatin1: true).Text);

    [Fact]
    public void Read_OfADirectory_SaysSo() =>
        Errors.AssertMessage("named:1:1: error: this is a directory, expected a file", () => SourceText.Read(_folder.Path, "named", 100));

    [Theory]
    [InlineData("missing.obj")]
    [InlineData("no/such/folder.obj")]
    public void Read_OfAMissingFile_SaysSo(string name) =>
        Errors.AssertMessage("named:1:1: error: file not found", () => SourceText.Read(_folder[name], "named", 100));

    [Fact]
    public void Read_BeyondTheLimit_NamesIt()
    {
        var error = Errors.ThrownBy(() => SourceText.Read(_folder.Write("f", new string('#', 101)), "named", 100)).Diagnostic;
        Assert.True(error.IsLimitExceeded);
        Assert.Equal("the file has 101 bytes, more than the limit of 100", error.Message);
    }

    [Fact]
    public void Read_AtTheLimit_Succeeds() =>
        Assert.Equal(100, SourceText.Read(_folder.Write("f", new string('#', 100)), "named", 100).Text.Length);

    [SkippableFact]
    public void Read_OfADevice_IsRefused()
    {
        Elsewhere.SkipIf(!File.Exists("/dev/zero"), "there is no /dev/zero");
        Assert.Equal("named:1:1: error: this is a pipe or a device, expected a file",
            Errors.ThrownBy(() => SourceText.Read("/dev/zero", "named", 100)).Diagnostic.ToString());
    }

    private SourceText Read(byte[] bytes, bool acceptLatin1 = false)
    {
        File.WriteAllBytes(_folder["file"], bytes);
        return SourceText.Read(_folder["file"], "named", 1000, acceptLatin1);
    }
}
