using FractalEngine.Parsing.Assets;
using FractalEngine.Parsing.Text;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Parsing.Assets;

/// <summary>Tests that a cache keeps what the last file needs, and nothing else.</summary>
public sealed class AssetCacheMemoryTests : IDisposable
{
    private readonly TemporaryFolder _folder = new();
    private readonly AssetCache _cache = new();

    public AssetCacheMemoryTests()
    {
        _folder.Write("painted.obj", "mtllib painted.mtl\nusemtl a\n" + SampleFiles.Cube);
        _folder.Write("painted.mtl", "newmtl a\nKd 1 0 0\n");
        _folder.Write("cube.obj", SampleFiles.Cube);
        _folder.Write("row.fdo", SampleFiles.Row("3"));
        _folder.Write("other.obj", SampleFiles.Cube);
        _folder.Write("faulty.obj", "v 1 2\n");
    }

    public void Dispose() => _folder.Dispose();

    /// <summary>Both files of each are read again: the mesh or fractal, and the material file or the base.</summary>
    [Theory]
    [InlineData("painted.obj")]
    [InlineData("row.fdo")]
    public void Load_AfterAnotherFile_ReadsEveryFileAgain(string file)
    {
        Assert.Equal(2, CountReads(file));
        Assert.Equal(0, CountReads(file));
        Assert.Equal(1, CountReads("other.obj"));
        Assert.Equal(2, CountReads(file));
    }

    [Theory]
    [InlineData("painted.obj")]
    [InlineData("row.fdo")]
    public void Load_AfterAFaultyFile_ReadsNothingAgain(string file)
    {
        Assert.Equal(2, CountReads(file));
        Assert.Throws<SourceException>(() => CountReads("faulty.obj"));
        Assert.Equal(0, CountReads(file));
    }

    private int CountReads(string file)
    {
        AssetLoader.Load(_folder[file], null, null, _cache);
        return _cache.ReadCount;
    }
}
