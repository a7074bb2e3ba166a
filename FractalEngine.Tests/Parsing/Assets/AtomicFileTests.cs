using FractalEngine.Parsing.Assets;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Parsing.Assets;

public sealed class AtomicFileTests : IDisposable
{
    private readonly TemporaryFolder _folder = new();

    public void Dispose() => _folder.Dispose();

    [Theory]
    [InlineData(null)]
    [InlineData("a much longer text than before")]
    public void Write_CreatesOrReplacesTheFile(string? before)
    {
        if (before is not null)
        {
            _folder.Write("a", before);
        }

        AtomicFile.Write(_folder["a"], stream => stream.Write("new"u8));
        Assert.Equal("new", File.ReadAllText(_folder["a"]));
        Assert.Single(Directory.GetFiles(_folder.Path));
    }

    [Fact]
    public void Write_ThatFailsHalfway_LeavesNoFile()
    {
        Assert.Throws<InvalidOperationException>(() => AtomicFile.Write(_folder["a"], Fail));
        Assert.Empty(Directory.GetFileSystemEntries(_folder.Path));
    }

    [Fact]
    public void Write_ThatFailsHalfway_LeavesWhatWasThere()
    {
        _folder.Write("a", "old");
        Assert.Throws<InvalidOperationException>(() => AtomicFile.Write(_folder["a"], Fail));
        Assert.Equal("old", File.ReadAllText(_folder["a"]));
        Assert.Single(Directory.GetFileSystemEntries(_folder.Path));
    }

    [Fact]
    public void Write_WhileWriting_LeavesTheOldContentsReadable()
    {
        _folder.Write("a", "old");
        AtomicFile.Write(_folder["a"], stream =>
        {
            stream.Write("new"u8);
            stream.Flush();
            Assert.Equal("old", File.ReadAllText(_folder["a"]));
        });
    }

    [Fact]
    public void Write_OverADirectory_IsAnIOError()
    {
        Assert.ThrowsAny<IOException>(() => AtomicFile.Write(_folder.Path, _ => { }));
        Assert.True(Directory.Exists(_folder.Path));
    }

    [Fact]
    public void Write_IntoAMissingFolder_MakesIt()
    {
        AtomicFile.Write(_folder["new/folder/a"], stream => stream.Write("new"u8));
        Assert.Equal("new", File.ReadAllText(_folder["new/folder/a"]));
    }

    [Fact]
    public void Write_BelowAFile_IsAnIOError()
    {
        _folder.Write("a", "old");
        Assert.ThrowsAny<IOException>(() => AtomicFile.Write(_folder["a/b"], _ => { }));
        Assert.Equal("old", File.ReadAllText(_folder["a"]));
    }

    [SkippableFact]
    public void Write_ThroughALink_ReplacesItsTargetAndKeepsPermissions()
    {
        Skip.If(OperatingSystem.IsWindows(), "links and modes are those of Unix");
        _folder.Write("target", "old");
        File.CreateSymbolicLink(_folder["link"], "target");
        if (!OperatingSystem.IsWindows())
        {
            File.SetUnixFileMode(_folder["target"], UnixFileMode.UserRead | UnixFileMode.UserWrite | UnixFileMode.GroupRead);
            AtomicFile.Write(_folder["link"], stream => stream.Write("new"u8));
            Assert.Equal("new", File.ReadAllText(_folder["target"]));
            Assert.NotNull(new FileInfo(_folder["link"]).LinkTarget);
            Assert.Equal(UnixFileMode.UserRead | UnixFileMode.UserWrite | UnixFileMode.GroupRead, File.GetUnixFileMode(_folder["target"]));
        }
    }

    private static void Fail(Stream stream)
    {
        stream.Write("half"u8);
        throw new InvalidOperationException();
    }
}
