using FractalEngine.Core.Files;
using FractalEngine.Parsing.Assets;
using FractalEngine.Parsing.Text;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Parsing.Assets;

public sealed class AssetCacheTests : IDisposable
{
    private const string Scene = "o \"a.obj\" #\no \"tree.fdo\" #\no \"a.obj\" ((2, 0, 0), #, #)\n";

    private readonly TemporaryFolder _folder = new();
    private readonly AssetCache _cache = new();

    public AssetCacheTests()
    {
        _folder.Write("scene.sdo", Scene);
        _folder.Write("a.obj", "mtllib a.mtl\nusemtl a\n" + SampleFiles.Cube);
        _folder.Write("a.mtl", "newmtl a\nKd 1 0 0\nmap_Kd a.png\n");
        _folder.Write("cube.obj", SampleFiles.Cube);
        _folder.Write("tree.fdo", SampleFiles.Row("3"));
    }

    public void Dispose() => _folder.Dispose();

    [Fact]
    public void Load_Again_ReadsOnlyTheSceneAndKeepsAllModels()
    {
        var first = Load();
        Assert.Equal(5, _cache.ReadCount);
        var second = Load();
        Assert.Equal(1, _cache.ReadCount);
        Assert.Equal(first.Scene.Models, second.Scene.Models);
        Assert.Equal(first.StorageBytes, second.StorageBytes);
        Assert.Equal(first.Warnings.AsEnumerable(), second.Warnings);
        Assert.Contains(_folder["a.png"], _cache.Files);
        Assert.Equal(FileStamp.Missing, _cache.Files[_folder["a.png"]]);
    }

    [Fact]
    public void Load_Again_RepeatsTheWarningsOfEachFile()
    {
        _folder.Write("b.obj", "curv 1\n" + SampleFiles.Cube);
        _folder.Write("c.obj", SampleFiles.Cube + "curv 1\ncurv 2\n");
        _folder.Write("scene.sdo", "o \"b.obj\" #\no \"a.obj\" #\no \"c.obj\" #\n");
        var first = Load().Warnings;
        Assert.True(first.Select(static warning => warning.File).Distinct().Count() > 1);
        Assert.Equal(first.AsEnumerable(), Load().Warnings);
    }

    [Theory]
    [InlineData("a.mtl", "newmtl a\nKd 0 1 0\n", 0)]
    [InlineData("a.png", "not an image", 0)]
    [InlineData("cube.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", 1)]
    public void Load_AfterAChange_KeepsTheOtherModels(string file, string text, int changed)
    {
        var first = Load().Scene.Models.ToArray();
        _folder.Write(file, text);
        var second = Load().Scene.Models.ToArray();
        Assert.NotSame(first[changed], second[changed]);
        Assert.Same(first[1 - changed], second[1 - changed]);
        if (changed == 0)
        {
            // Only materials have changed.
            Assert.Same(first[0].Mesh, second[0].Mesh);
        }
    }

    [Fact]
    public void Load_OfAFaultyFile_NamesWhatWasReadAndKeepsTheRest()
    {
        var first = Load();
        _folder.Write("tree.fdo", "nonsense");
        Assert.Throws<SourceException>(Load);
        Assert.Contains(_folder["tree.fdo"], _cache.Files);
        _folder.Write("tree.fdo", SampleFiles.Row("3"));
        Assert.Same(first.Scene.Models.First(), Load().Scene.Models.First());
    }

    [Fact]
    public void Load_OfASharedMesh_KnowsItsFilesForEachModel()
    {
        _folder.Write("scene.sdo", "o \"cube.obj\" #\no \"tree.fdo\" #\n");
        var first = Load().Scene.Models.ToArray();
        _folder.Write("cube.obj", SampleFiles.Cube + "\n");
        var second = Load().Scene.Models.ToArray();
        Assert.NotSame(first[0], second[0]);
        Assert.NotSame(first[1], second[1]);
        Assert.Same(second[0].Mesh, second[1].Mesh);
    }

    private LoadedFile Load() => AssetLoader.Load(_folder["scene.sdo"], null, null, _cache);
}
