using FractalEngine.Core.Fractals;
using FractalEngine.Core.Scenes;
using FractalEngine.Parsing.Assets;
using FractalEngine.Parsing.Editing;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Parsing.Editing;

/// <summary>Tests the fractals to begin with. The driven window makes one of them in the table of interactions.</summary>
public sealed class NewFractalFileTests : IDisposable
{
    private readonly TemporaryFolder _folder = new();

    public static TheoryData<string> Names => [.. FractalTemplate.All.Select(static template => template.Name)];

    public void Dispose() => _folder.Dispose();

    [Theory]
    [MemberData(nameof(Names))]
    public void Write_OfEveryTemplate_LoadsWithoutWarnings(string name)
    {
        var template = FractalTemplate.All.Single(template => template.Name == name);
        var path = NewFractalFile.Propose(template, _folder.Path);
        NewFractalFile.Write(template, path);
        var file = AssetLoader.Load(path);
        Assert.Empty(file.Warnings);
        var fractal = Assert.IsType<FractalModel>(file.Scene.Models.Single()).Fractal;
        Assert.InRange(DistinctInstances.Count(fractal)!.Value * fractal.BaseMesh.FaceCount, 100, 200_000);
    }

    [Fact]
    public void Propose_WhereNamesAreTaken_FindsAnother()
    {
        var template = FractalTemplate.All[0];
        Assert.Equal(_folder["tree.fdo"], NewFractalFile.Propose(template, _folder.Path));
        _folder.Write("tree.fdo", "");
        Assert.Equal(_folder["tree-2.fdo"], NewFractalFile.Propose(template, _folder.Path));
    }

    [Theory]
    [InlineData("taken.fdo", "taken.fdo exists already, and is not replaced")]
    [InlineData("new.obj", "the name of a fractal ends in .fdo")]
    public void Write_WhereItCanNot_SaysWhyAndChangesNothing(string name, string message)
    {
        _folder.Write("taken.fdo", "kept");
        var exception = Assert.Throws<IOException>(() => NewFractalFile.Write(FractalTemplate.All[0], _folder[name]));
        Assert.Equal(message, exception.Message);
        Assert.Equal(["taken.fdo"], Directory.GetFiles(_folder.Path).Select(Path.GetFileName).Order());
        Assert.All(Directory.GetFiles(_folder.Path), static path => Assert.Equal("kept", File.ReadAllText(path)));
    }
}
