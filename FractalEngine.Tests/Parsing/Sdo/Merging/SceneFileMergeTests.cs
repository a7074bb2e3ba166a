using System.Text;
using FractalEngine.Parsing.Sdo;
using FractalEngine.Parsing.Sdo.Merging;
using FractalEngine.Parsing.Text;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Parsing.Sdo.Merging;

/// <summary>Tests merges into files that need no change, that are no text, or that can't be read.</summary>
[Collection(ConsoleTests.Name)]
public sealed class SceneFileMergeTests : IDisposable
{
    private static readonly DateTime Past = new(2001, 2, 3, 4, 5, 6, DateTimeKind.Utc);

    private readonly TemporaryFolder _folder = new();

    public void Dispose() => _folder.Dispose();

    /// <summary>A program that watches the file has nothing to read again.</summary>
    [Fact]
    public void Write_OfNoChange_LeavesTheFileAlone()
    {
        string path = _folder.Write("scene.sdo", "fog 2\n# mine\n");
        File.SetLastWriteTimeUtc(path, Past);
        Assert.Equal("fog 2\n# mine\n", SceneFileMerge.Write(path, "fog 1\n", "fog 2\n").Text);
        Assert.Equal(Past, File.GetLastWriteTimeUtc(path));
    }

    [Fact]
    public void Write_OfAConflict_LeavesTheFileAlone()
    {
        string path = _folder.Write("scene.sdo", "fog 3\n");
        File.SetLastWriteTimeUtc(path, Past);
        Assert.Equal(new MergeConflict("fog 2", "fog 3"), Assert.Single(SceneFileMerge.Write(path, "fog 1\n", "fog 2\n").Conflicts));
        Assert.Equal(("fog 3\n", Past), (File.ReadAllText(path), File.GetLastWriteTimeUtc(path)));
    }

    [Fact]
    public void Write_OfAnEmptyTextWhereNoFileIs_CreatesIt()
    {
        Assert.Equal("", SceneFileMerge.Write(_folder["new.sdo"], "", "").Text);
        Assert.Equal("", File.ReadAllText(_folder["new.sdo"]));
    }

    /// <summary>What no reader takes for text keeps its bytes, each of which is a character of the result.</summary>
    [Fact]
    public void Write_IntoAFileThatIsNoText_KeepsItsBytes()
    {
        string path = _folder["scene.sdo"];
        File.WriteAllBytes(path, [(byte)'#', 0, 0xE4, (byte)'\n']);
        Assert.Equal("#\0ä\nfog 1\n", SceneFileMerge.Write(path, "", "fog 1\n").Text);
        Assert.Equal(Encoding.Latin1.GetBytes("#\0ä\nfog 1\n"), File.ReadAllBytes(path));
    }

    [Fact]
    public void Write_IntoAFileBeyondTheLimit_SaysSo()
    {
        string path = _folder.Write("scene.sdo", "fog 1\n# 1\n");
        ParsingLimits.DescriptionBytes.Value = 9;
        try
        {
            Assert.Equal(
                $"{path} can't be saved: the file has 10 bytes, more than the limit of 9",
                Assert.Throws<IOException>(() => SceneFileMerge.Write(path, "fog 1\n", "fog 2\n")).Message);
        }
        finally
        {
            ParsingLimits.DescriptionBytes.Value = ParsingLimits.DescriptionBytes.Default;
        }
    }

    [Fact]
    public void Write_IntoAFolderThatIsGone_NamesIt()
    {
        string path = _folder["gone/scene.sdo"];
        Assert.Equal(
            $"{path} can't be written: the folder {_folder["gone"]} is gone",
            Assert.Throws<IOException>(() => SceneFileMerge.Write(path, "", "fog 1\n")).Message);
    }

    /// <summary>The offset is that of the letter, behind any blanks and lines before it.</summary>
    [Fact]
    public void DeclarationOffset_OfAnObject_IsThatOfItsLetter()
    {
        const string text = "# o\n\to \"a.obj\" #\r\n\r\nfog 1\n  p \"b.obj\" # 1\n";
        var parsed = SceneParser.Parse(new("test.sdo", text));
        Assert.Equal(text.IndexOf("o \"a", StringComparison.Ordinal), parsed.DeclarationOffset(0));
        Assert.Equal(text.IndexOf("p \"b", StringComparison.Ordinal), parsed.DeclarationOffset(1));
        foreach (int index in (int[])[-1, 2])
        {
            var exception = Assert.Throws<ArgumentOutOfRangeException>(() => parsed.DeclarationOffset(index));
            Assert.Equal(("index", (object)index), (exception.ParamName, exception.ActualValue));
            Assert.StartsWith("the scene has no such declaration", exception.Message, StringComparison.Ordinal);
        }
    }
}
