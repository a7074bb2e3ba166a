using FractalEngine.App.Window;
using FractalEngine.Core.Scenes;
using FractalEngine.Parsing.Assets;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.App.Window;

/// <summary>Tests the fractals that a user begins with.</summary>
public sealed class NewFractalFileTests : IDisposable
{
    private readonly TemporaryFolder _folder = new();

    public void Dispose() => _folder.Dispose();

    [Theory]
    [InlineData("tree", 16, 781)]
    [InlineData("triangle", 8, 729)]
    [InlineData("cubes", 12, 781)]
    public void Write_OfATemplate_LoadsWithoutAWarning(string name, int faceCount, int minInstances)
    {
        var template = FractalTemplate.All.Single(template => template.Name == name);
        var path = NewFractalFile.Propose(template, _folder.Path);
        Assert.Equal(_folder[name + ".fdo"], path);
        NewFractalFile.Write(template, path);
        var file = AssetLoader.Load(path);
        Assert.Empty(file.Warnings);
        var fractal = Assert.IsType<FractalModel>(Assert.Single(file.Scene.Models));
        Assert.True(fractal.Mesh.FaceCount >= faceCount, $"{fractal.Mesh.FaceCount} faces");
        Assert.True(fractal.InstanceCount >= minInstances, $"{fractal.InstanceCount} instances");
        Assert.True(fractal.Bounds.Size.IsFinite());
        Assert.Equal(_folder[name + "-2.fdo"], NewFractalFile.Propose(template, _folder.Path));
    }

    [Theory]
    [InlineData("taken.fdo", "taken.fdo exists already, and is not replaced")]
    [InlineData("mesh.fdo", "mesh-base.obj exists already, and is not replaced")]
    [InlineData("tree.sdo", "the name of a fractal ends in .fdo")]
    [InlineData("a\"b.fdo", "the name of a fractal has no quote and no line break")]
    public void Write_ThatWouldHarm_IsRefused(string name, string message)
    {
        _folder.Write("taken.fdo", "mine");
        _folder.Write("mesh-base.obj", "mine");
        var exception = Assert.Throws<IOException>(() => NewFractalFile.Write(FractalTemplate.All[0], Path.Combine(_folder.Path, name)));
        Assert.Equal(message, exception.Message);
        Assert.Equal(["mesh-base.obj", "taken.fdo"], Directory.GetFiles(_folder.Path).Select(Path.GetFileName).Order());
        Assert.Equal("mine", File.ReadAllText(_folder["taken.fdo"]));
    }
}
