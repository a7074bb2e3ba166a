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
        Assert.InRange(file.Scene.Models.Single().FaceCount!.Value, 100, 200_000);
    }

    [Fact]
    public void Propose_WhereNamesAreTaken_FindsAnother()
    {
        var template = FractalTemplate.All[0];
        Assert.Equal(_folder["tree.fdo"], NewFractalFile.Propose(template, _folder.Path));
        _folder.Write("tree.fdo", "");
        // The base mesh would replace this one.
        _folder.Write("tree-2-base.obj", "");
        Assert.Equal(_folder["tree-3.fdo"], NewFractalFile.Propose(template, _folder.Path));
    }

    [Theory]
    [InlineData("taken.fdo", "taken.fdo exists already, and is not replaced")]
    [InlineData("new.fdo", "new-base.obj exists already, and is not replaced")]
    [InlineData("new.obj", "the name of a fractal ends in .fdo")]
    [InlineData("a\"b.fdo", "the name of a fractal has no quote and no line break")]
    public void Write_WhereItCanNot_SaysWhyAndChangesNothing(string name, string message)
    {
        _folder.Write("taken.fdo", "kept");
        _folder.Write("new-base.obj", "kept");
        var exception = Assert.Throws<IOException>(() => NewFractalFile.Write(FractalTemplate.All[0], _folder[name]));
        Assert.Equal(message, exception.Message);
        Assert.Equal(["new-base.obj", "taken.fdo"], Directory.GetFiles(_folder.Path).Select(Path.GetFileName).Order());
        Assert.All(Directory.GetFiles(_folder.Path), static path => Assert.Equal("kept", File.ReadAllText(path)));
    }
}
