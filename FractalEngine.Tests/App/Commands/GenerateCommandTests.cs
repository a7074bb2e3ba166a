using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.App.Commands;

/// <summary>Tests the command <c>generate</c>.</summary>
[Collection(ConsoleTests.Name)]
public sealed class GenerateCommandTests : IDisposable
{
    private readonly TemporaryFolder _folder = new();

    public void Dispose() => _folder.Dispose();

    [Fact]
    public void Generate_OfATerrain_WritesAMeshWithItsCountAtTheHead()
    {
        var (exitCode, output, error) = Run("generate", "terrain", "--output", "land.obj", "--seed", "7", "--faces", "1000");
        Assert.Equal((0, "1000"), (exitCode, output.Trim()));
        Assert.Matches(@"^wrote land\.obj: 1000 faces, [0-9.]+ kB, [0-9.]+ s\n$", error);
        Assert.Equal("# Mesh count: 1000", File.ReadLines(_folder["land.obj"]).First());
        Assert.Contains("1000", Run("count", "land.obj").Output, StringComparison.Ordinal);
    }

    [Fact]
    public void Generate_WithTheSameSeed_WritesTheSameBytes()
    {
        Run("generate", "tree-stump", "-o", "a.obj", "--seed", "18446744073709551615", "--faces", "3000");
        Run("generate", "tree-stump", "-o", "b.obj", "--seed", "18446744073709551615", "--faces", "3000");
        Assert.Equal(File.ReadAllBytes(_folder["a.obj"]), File.ReadAllBytes(_folder["b.obj"]));
    }

    [Fact]
    public void Generate_OfAnUnknownName_ListsTheKnownOnes()
    {
        var (exitCode, output, error) = Run("generate", "teapot", "-o", "a.obj");
        Assert.Equal((2, ""), (exitCode, output));
        Assert.Equal(
            "error: unknown mesh 'teapot', expected one of: spaceship-interior, tree-stump, terrain, icosphere, torus-knot\n",
            error.ReplaceLineEndings("\n"));
        Assert.False(File.Exists(_folder["a.obj"]));
    }

    [Theory]
    [InlineData("--seed", "-1")]
    [InlineData("--seed", "1.5")]
    [InlineData("--faces", "0")]
    [InlineData("--faces", "many")]
    public void Generate_OfInvalidNumbers_IsWrongUsage(string option, string value) =>
        Assert.Equal(2, Run("generate", "terrain", "-o", "a.obj", option, value).ExitCode);

    private AppResult Run(params string[] arguments) => AppInProcess.Run(_folder.Path, arguments);
}
