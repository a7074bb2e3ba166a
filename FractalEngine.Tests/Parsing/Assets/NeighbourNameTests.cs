using FractalEngine.Parsing.Assets;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Parsing.Assets;

/// <summary>Tests which of its neighbours a missing file is taken for: those of its kind with a similar name.</summary>
public sealed class NeighbourNameTests : IDisposable
{
    private readonly TemporaryFolder _folder = new();

    public NeighbourNameTests()
    {
        _folder.Write("house.obj", SampleFiles.Cube);
        _folder.Write("garden.fdo", SampleFiles.Row("3"));
        _folder.Write("gardens.sdo", "o \"house.obj\" #\n");
        _folder.Write("lake.txt", "");
    }

    public void Dispose() => _folder.Dispose();

    [Theory]
    [InlineData("hous.obj", ": did you mean \"house.obj\"?")]
    [InlineData("house.ply", ": did you mean \"house.obj\"?")]
    [InlineData("house.fdo", "")]
    [InlineData("gardens.fdo", ": did you mean \"garden.fdo\"?")]
    [InlineData("garden.sdo", ": did you mean \"gardens.sdo\"?")]
    [InlineData("lake.obj", "")]
    [InlineData("no/house.obj", "")]
    public void Load_OfAMissingFile_AsksForOneOfItsKind(string name, string question)
    {
        string path = _folder[name];
        Assert.Equal($"{path}:1:1: error: file not found{question}", Errors.MessageOf(() => AssetLoader.Load(path)));
    }
}
