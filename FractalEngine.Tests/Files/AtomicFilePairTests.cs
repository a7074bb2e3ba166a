using FractalEngine.Core.Files;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Files;

/// <summary>Tests that two files that belong together are written both or neither.</summary>
public sealed class AtomicFilePairTests : IDisposable
{
    private readonly TemporaryFolder _folder = new();

    public void Dispose() => _folder.Dispose();

    [Theory]
    [InlineData(false)]
    [InlineData(true)]
    public void WritePair_WritesBoth(bool isOverOldFiles)
    {
        if (isOverOldFiles)
        {
            WriteOld();
        }

        AtomicFile.WritePair(
            _folder["m.mtl"], static stream => stream.Write("2"u8), _folder["m.obj"], static stream => stream.Write("1"u8));
        Assert.Equal("12", Contents());
    }

    [Theory]
    [InlineData(true)]
    [InlineData(false)]
    public void WritePair_WhereOneFails_ChangesNeither(bool isFirst)
    {
        WriteOld();
        Assert.Throws<InvalidOperationException>(() => AtomicFile.WritePair(
            _folder["m.mtl"], stream => Write(stream, !isFirst), _folder["m.obj"], stream => Write(stream, isFirst)));
        Assert.Equal("oldold", Contents());
    }

    [Theory]
    [InlineData("m.mtl")]
    [InlineData("m.obj")]
    public void WritePair_WhereATargetIsAFolder_ChangesNeither(string folder)
    {
        WriteOld();
        File.Delete(_folder[folder]);
        Directory.CreateDirectory(_folder[folder]);
        Assert.Throws<IOException>(() => AtomicFile.WritePair(
            _folder["m.mtl"], stream => Write(stream, false), _folder["m.obj"], stream => Write(stream, false)));
        Assert.Equal("old", File.ReadAllText(_folder[folder == "m.mtl" ? "m.obj" : "m.mtl"]));
        Assert.Equal(2, Directory.GetFileSystemEntries(_folder.Path).Length);
    }

    /// <summary>The second file becomes a folder after both are written: its rename fails when the first file has its name.</summary>
    [Theory]
    [InlineData(true)]
    [InlineData(false)]
    public void WritePair_WhereTheLastRenameFails_RestoresTheCompanion(bool hadCompanion)
    {
        if (hadCompanion)
        {
            _folder.Write("m.mtl", "old");
        }

        Assert.Throws<IOException>(() => AtomicFile.WritePair(
            _folder["m.mtl"], _ => Directory.CreateDirectory(_folder["m.obj"]), _folder["m.obj"], stream => Write(stream, false)));
        Assert.Equal(hadCompanion ? "old" : null, File.Exists(_folder["m.mtl"]) ? File.ReadAllText(_folder["m.mtl"]) : null);
        Assert.Equal(hadCompanion ? 2 : 1, Directory.GetFileSystemEntries(_folder.Path).Length);
    }

    /// <summary>Names may have 255 bytes; that of the temporary file is cut, also within letters of several bytes.</summary>
    [Theory]
    [InlineData('n', 251)]
    [InlineData('ä', 125)]
    [InlineData('中', 83)]
    public void Write_ToTheLongestName_IsWritten(char letter, int count)
    {
        var name = new string(letter, count) + ".obj";
        AtomicFile.Write(_folder[name], stream => Write(stream, false));
        Assert.Equal([name], Directory.GetFiles(_folder.Path).Select(Path.GetFileName));
    }

    private void WriteOld()
    {
        _folder.Write("m.mtl", "old");
        _folder.Write("m.obj", "old");
    }

    private string Contents()
    {
        Assert.Equal(2, Directory.GetFileSystemEntries(_folder.Path).Length);
        return File.ReadAllText(_folder["m.obj"]) + File.ReadAllText(_folder["m.mtl"]);
    }

    private static void Write(Stream stream, bool fails)
    {
        stream.Write("half"u8);
        if (fails)
        {
            throw new InvalidOperationException();
        }
    }
}
