using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.App.Shell;

/// <summary>Tests that no output replaces a file that was read, and how names of files are shown.</summary>
[Collection(ConsoleTests.Name)]
public sealed class ReadFileTests : IDisposable
{
    private readonly TemporaryFolder _folder = new();

    public ReadFileTests() => _folder.Write("cube.obj", SampleFiles.Cube);

    public void Dispose() => _folder.Dispose();

    [SkippableTheory]
    [InlineData("cube.obj")]
    [InlineData("link.obj")]
    public void Export_OntoAFileThatWasRead_IsRefusedAndReplacesNothing(string output)
    {
        Elsewhere.SkipOnWindows("links need rights there");
        _folder.Write("row.fdo", SampleFiles.Row("3"));
        File.CreateSymbolicLink(_folder["link.obj"], _folder["cube.obj"]);
        var (exitCode, _, error) = AppInProcess.Run(_folder.Path, "export", "row.fdo", "--output", output);
        Assert.Equal((2, $"error: {output} is one of the files that are read, and is not overwritten"), (exitCode, error.Trim()));
        Assert.Equal(SampleFiles.Cube, File.ReadAllText(_folder["cube.obj"]));
    }

    [Fact]
    public void Approximate_WithAnImageOntoATextureThatWasRead_IsRefused()
    {
        _folder.Write("m.mtl", "newmtl A\nmap_Kd tiles.png\n");
        _folder.Write("a.obj", "mtllib m.mtl\nusemtl A\n" + SampleFiles.Cube);
        var image = File.ReadAllBytes(Repository.Full("assets/models/crate.png"));
        File.WriteAllBytes(_folder["tiles.png"], image);
        var (exitCode, _, error) = AppInProcess.Run(_folder.Path, "approximate", "a.obj", "--output", "a.fdo", "--image", "tiles.png");
        Assert.Equal((2, "error: tiles.png is one of the files that are read, and is not overwritten"), (exitCode, error.Trim()));
        Assert.Equal(image, File.ReadAllBytes(_folder["tiles.png"]));
        Assert.False(File.Exists(_folder["a.fdo"]));
    }

    [SkippableFact]
    public void Export_OntoAFileThatWasReadThroughALinkedFolder_IsRefused()
    {
        Elsewhere.SkipOnWindows("links need rights there");
        Directory.CreateSymbolicLink(_folder["elsewhere"], _folder.Path);
        var (exitCode, _, error) = AppInProcess.Run(_folder.Path, "export", "cube.obj", "--output", "elsewhere/cube.obj");
        Assert.Equal((2, "error: elsewhere/cube.obj is one of the files that are read, and is not overwritten"), (exitCode, error.Trim()));
        Assert.Equal(SampleFiles.Cube, File.ReadAllText(_folder["cube.obj"]));
    }

    [Theory]
    [InlineData("a\u001B[31m.obj", "a\\u001B[31m.obj:1:1: error: file not found")]
    [InlineData("a\u202Egpj.obj", "a\\u202Egpj.obj:1:1: error: file not found")]
    public void Messages_WithControlCharacters_ShowThemEscaped(string file, string message) =>
        Assert.Equal(message, AppInProcess.Run(_folder.Path, "info", file).Error.Trim());
}
