using System.Diagnostics;
using System.Text;
using FractalEngine.Core.Files;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Files;

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
    public void Write_ToAFullDisk_NamesThePathOnce()
    {
        var error = Assert.Throws<IOException>(() => AtomicFile.Write(_folder["a"], static stream =>
            throw new IOException($"No space left on device : '{((FileStream)stream).Name}'")));
        Assert.Equal($"{_folder["a"]} can't be written: No space left on device", error.Message);
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
        Elsewhere.SkipOnWindows("links and modes are those of Unix");
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

    [SkippableFact]
    public void Write_IntoAPipe_FeedsItsReader()
    {
        Elsewhere.SkipOnWindows("pipes are those of Unix");
        Assert.Equal(0, Run("mkfifo", "pipe.obj"));
        foreach (var text in (string[])["first", "second"])
        {
            // The second one would read a file that never changes, had the first one replaced the pipe.
            var reader = Task.Run(() => File.ReadAllText(_folder["pipe.obj"]));
            AtomicFile.Write(_folder["pipe.obj"], stream => stream.Write(Encoding.UTF8.GetBytes(text)));
            Assert.True(reader.Wait(Polling.Deadline));
            Assert.Equal(text, reader.Result);
        }

        Assert.Equal(0, Run("test", "-p", "pipe.obj"));
        Assert.Single(Directory.GetFileSystemEntries(_folder.Path));
    }

    [SkippableFact]
    public void Write_IntoADevice_LeavesTheDevice()
    {
        // A node of its own: an error here must not harm the machine's.
        Elsewhere.SkipIf(OperatingSystem.IsWindows() || Run("mknod", "full", "c", "1", "7") != 0, "this user can't make device nodes");
        File.CreateSymbolicLink(_folder["link"], "full");
        foreach (var name in (string[])["full", "link"])
        {
            var error = Assert.Throws<IOException>(() => AtomicFile.Write(_folder[name], stream => stream.Write("new"u8)));
            Assert.StartsWith($"{_folder[name]} can't be written: ", error.Message, StringComparison.Ordinal);
        }

        Assert.Equal(0, Run("test", "-c", "full"));
        Assert.Equal(2, Directory.GetFileSystemEntries(_folder.Path).Length);
    }

    [SkippableFact]
    public void Write_OfAPrivateFile_IsPrivateMeanwhile()
    {
        Elsewhere.SkipOnWindows("modes are those of Unix");
        if (!OperatingSystem.IsWindows())
        {
            var mode = UnixFileMode.UserRead | UnixFileMode.UserWrite;
            File.SetUnixFileMode(_folder.Write("a", "old"), mode);
            var meanwhile = default(UnixFileMode);
            AtomicFile.Write(_folder["a"], _ =>
            {
                foreach (var file in Directory.GetFiles(_folder.Path))
                {
                    meanwhile |= OperatingSystem.IsWindows() ? mode : File.GetUnixFileMode(file);
                }
            });
            Assert.Equal(mode, meanwhile);
            Assert.Equal(mode, File.GetUnixFileMode(_folder["a"]));
        }
    }

    [Fact]
    public void Update_OfAFileThatChangesMeanwhile_ChangesWhatThatHasLeft()
    {
        var path = _folder.Write("a", "old");
        var count = 0;
        AtomicFile.Update(path, stamp =>
        {
            Assert.Equal(FileStamp.Of(path), stamp);
            var text = File.ReadAllText(path);
            if (++count < 3)
            {
                File.WriteAllText(path, text + count);
            }

            return System.Text.Encoding.UTF8.GetBytes(text + " new");
        });
        Assert.Equal((3, "old12 new"), (count, File.ReadAllText(path)));
        AtomicFile.Update(path, static _ => null);
        Assert.Equal("old12 new", File.ReadAllText(path));
    }

    [Fact]
    public void Update_OfAFileThatChangesAllTheTime_IsGivenUp()
    {
        var path = _folder.Write("a", "");
        var error = Assert.Throws<IOException>(() => AtomicFile.Update(path, _ =>
        {
            File.AppendAllText(path, "x");
            return "new"u8.ToArray();
        }));
        Assert.EndsWith("another program changes it all the time", error.Message, StringComparison.Ordinal);
        Assert.DoesNotContain("new", File.ReadAllText(path), StringComparison.Ordinal);
    }

    [Fact]
    public void Write_BelowAFile_NamesTheFileThatIsNoFolder()
    {
        _folder.Write("a", "old");
        var error = Assert.Throws<IOException>(() => AtomicFile.Write(_folder["a/b/c"], _ => { }));
        Assert.Equal($"{_folder["a/b/c"]} can't be written: {_folder["a"]} is a file, not a directory", error.Message);
    }

    private int Run(string program, params string[] arguments)
    {
        using var process = Process.Start(
            new ProcessStartInfo(program, arguments) { WorkingDirectory = _folder.Path, RedirectStandardError = true })!;
        process.WaitForExit();
        return process.ExitCode;
    }

    private static void Fail(Stream stream)
    {
        stream.Write("half"u8);
        throw new InvalidOperationException();
    }
}
