using System.Text;
using FractalEngine.Parsing.Wavefront.Writing;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Parsing.Wavefront.Writing;

public sealed class MeshCountHeaderTests : IDisposable
{
    private readonly TemporaryFolder _folder = new();

    public void Dispose() => _folder.Dispose();

    [Theory]
    [InlineData("v 1 2 3\n", "# Mesh count: 7\nv 1 2 3\n")]
    [InlineData("v 1 2 3", "# Mesh count: 7\nv 1 2 3")]
    [InlineData("v 1 2 3\r\nf 1 1 1\r\n", "# Mesh count: 7\r\nv 1 2 3\r\nf 1 1 1\r\n")]
    [InlineData("# Monitor\n# Author\nv 1 2 3\n", "# Monitor\n# Author\n# Mesh count: 7\nv 1 2 3\n")]
    [InlineData("# Monitor\n# Mesh count: 9670\n\nv 1 2 3\n", "# Monitor\n# Mesh count: 7\n\nv 1 2 3\n")]
    [InlineData("# Mesh count: 9670\r\nv 1 2 3\r\n", "# Mesh count: 7\r\nv 1 2 3\r\n")]
    [InlineData("\uFEFFv 1 2 3\n", "\uFEFF# Mesh count: 7\nv 1 2 3\n")]
    [InlineData("\uFEFF# a\nv 1 2 3\n", "\uFEFF# a\n# Mesh count: 7\nv 1 2 3\n")]
    [InlineData("# only a comment", "# only a comment\n# Mesh count: 7\n")]
    [InlineData("# Mesh count: 9670 (by me)\nv 1 2 3\n", "# Mesh count: 7 (by me)\nv 1 2 3\n")]
    [InlineData("# MESH COUNT:\t12, once\nv 1 2 3\n", "# MESH COUNT:\t7, once\nv 1 2 3\n")]
    [InlineData("# Mesh count:\nv 1 2 3\n", "# Mesh count: 7\nv 1 2 3\n")]
    [InlineData("# Mesh count:12\nv 1 2 3\n", "# Mesh count: 7\nv 1 2 3\n")]
    [InlineData("# Mesh count: of the artist\nv 1 2 3\n", "# Mesh count: of the artist\n# Mesh count: 7\nv 1 2 3\n")]
    [InlineData("# Mesh count: 5.5 kg\nv 1 2 3\n", "# Mesh count: 5.5 kg\n# Mesh count: 7\nv 1 2 3\n")]
    [InlineData("# a\nv 1 2 3\r\nv 2 3 4\r\n", "# a\n# Mesh count: 7\nv 1 2 3\r\nv 2 3 4\r\n")]
    [InlineData("v 1 2 3\nv 2 3 4\r\n", "# Mesh count: 7\nv 1 2 3\nv 2 3 4\r\n")]
    [InlineData("# a\rv 1 2 3\rv 2 3 4\r", "# a\r# Mesh count: 7\rv 1 2 3\rv 2 3 4\r")]
    public void Update_InsertsOrCorrectsTheHeaderAndNothingElse(string before, string after)
    {
        var path = _folder.Write("a.obj", before);
        Assert.True(MeshCountHeader.Update(path, 7));
        Assert.Equal(Encoding.UTF8.GetBytes(after), File.ReadAllBytes(path));
    }

    [Fact]
    public void Update_OfUtf16_KeepsTheEncoding()
    {
        foreach (var encoding in new[] { Encoding.Unicode, Encoding.BigEndianUnicode })
        {
            File.WriteAllText(_folder["a.obj"], "# \u4E00\r\nv 1 2 3", encoding);
            Assert.True(MeshCountHeader.Update(_folder["a.obj"], 7));
            Assert.Equal([.. encoding.GetPreamble(), .. encoding.GetBytes("# \u4E00\r\n# Mesh count: 7\r\nv 1 2 3")],
                File.ReadAllBytes(_folder["a.obj"]));
            Assert.False(MeshCountHeader.Update(_folder["a.obj"], 7));
        }
    }

    [Theory]
    [InlineData("v 1 2 3\n")]
    [InlineData("# Monitor\r\nv 1 2 3")]
    [InlineData("\uFEFFv 1 2 3")]
    [InlineData("# only a comment")]
    public void Update_ASecondTime_ChangesNothing(string text)
    {
        var path = _folder.Write("a.obj", text);
        MeshCountHeader.Update(path, 7);
        var (bytes, time) = (File.ReadAllBytes(path), File.GetLastWriteTimeUtc(path));
        Assert.False(MeshCountHeader.Update(path, 7));
        Assert.Equal(bytes, File.ReadAllBytes(path));
        Assert.Equal(time, File.GetLastWriteTimeUtc(path));
    }

    [Fact]
    public void Update_OfBytesThatAreNoText_KeepsThem()
    {
        byte[] latin1 = [.. "# Gr"u8, 0xF6, 0xDF, 0xE9, .. "\nv 1 2 3\n"u8];
        File.WriteAllBytes(_folder["a.obj"], latin1);
        MeshCountHeader.Update(_folder["a.obj"], 7);
        Assert.Equal([.. "# Gr"u8, 0xF6, 0xDF, 0xE9, .. "\n# Mesh count: 7\nv 1 2 3\n"u8], File.ReadAllBytes(_folder["a.obj"]));
    }

    [Fact]
    public void Update_OfAnyHeader_LeavesAFileThatParsesToTheSame()
    {
        const string text = "# a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
        var path = _folder.Write("a.obj", text);
        MeshCountHeader.Update(path, 1);
        Assert.Equal(Samples.ParseObj(text).Mesh.VertexIndices.ToArray(),
            Samples.ParseObj(File.ReadAllText(path)).Mesh.VertexIndices.ToArray());
    }

    [Fact]
    public void Update_LeavesNoOtherFile()
    {
        MeshCountHeader.Update(_folder.Write("a.obj", "v 1 2 3\n"), 7);
        Assert.Equal([_folder["a.obj"]], Directory.GetFiles(_folder.Path));
    }
}
