using System.Text.Json;
using FractalEngine.Core.Images;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.App;

/// <summary>Tests what commands tell of single things, of several, and of work that they measure.</summary>
[Collection(ConsoleTests.Name)]
public sealed class ReportedWorkTests : IDisposable
{
    private readonly TemporaryFolder _folder = new();

    public void Dispose() => _folder.Dispose();

    [Fact]
    public void Export_OfOneFaceOfOneMaterial_CountsBoth()
    {
        _folder.Write("one.mtl", "newmtl a\nKd 1 0 0\n");
        _folder.Write("one.obj", "mtllib one.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\n");
        var (exitCode, output, error) = Run("export", "one.obj", "--output", "out/flat.obj");
        Assert.Equal((0, ""), (exitCode, output));
        Assert.Matches(@"^wrote out/flat\.obj: 1 face, 1 material in flat\.mtl, [0-9]+ bytes, [0-9]+\.[0-9] s\n$", error);
    }

    [Fact]
    public void Export_OfSeveralTexturesElsewhere_NamesTheFirst()
    {
        foreach (string name in (string[])["a", "b"])
        {
            _folder.Write($"models/{name}.png", "");
            using var stream = File.Create(_folder[$"models/{name}.png"]);
            PngWriter.Write(new PixelImage(1, 1, [1, 2, 3, 255]), stream);
        }

        _folder.Write("models/two.mtl", "newmtl a\nmap_Kd a.png\nnewmtl b\nmap_Kd b.png\n");
        _folder.Write(
            "models/two.obj",
            "mtllib two.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl a\nf 1/1 2/1 3/1\nusemtl b\nf 1/1 3/1 2/1\n");
        Assert.Equal(
            new AppResult(
                0, "",
                $"out/flat.mtl: warning: 2 textures, {_folder["models/a.png"]} first, lie outside the folder of the mesh: "
                + "load it with --allow-outside, or copy the images\n"),
            Run("export", "models/two.obj", "--output", "out/flat.obj", "--quiet"));
    }

    /// <summary>To prepare so many faces takes milliseconds, to read the clock twice far less than one.</summary>
    [Fact]
    public void Info_WithPrepare_MeasuresTheWholeWork()
    {
        Assert.Equal(0, Run("generate", "icosphere", "--output", "ball.obj", "--faces", "20000", "--quiet").ExitCode);
        var (exitCode, output, _) = Run("info", "ball.obj", "--json", "--prepare");
        Assert.Equal(0, exitCode);
        using var info = JsonDocument.Parse(output);
        double milliseconds = info.RootElement.GetProperty("prepareMilliseconds").GetDouble();
        Assert.True(milliseconds > 0.1, FormattableString.Invariant($"{milliseconds} ms"));
    }

    /// <summary>A step so long takes a falling body out of the range of a double at once.</summary>
    [Fact]
    public void Simulate_BeyondTheRangeOfNumbers_NamesTheFileAndWritesNothing()
    {
        _folder.Write("cube.obj", SampleFiles.Cube);
        _folder.Write("drop.sdo", "p \"cube.obj\" # 0.5 name \"stone\"\n");
        var (exitCode, output, error) = Run(
            "simulate", "drop.sdo", "--seconds", "1e200", "--step", "1e200", "--output", "drop.csv");
        Assert.Equal((1, ""), (exitCode, output));
        Assert.StartsWith(
            "drop.sdo:1:1: error: body stone has left the range of a double in step ", error, StringComparison.Ordinal);
        Assert.False(File.Exists(_folder["drop.csv"]));
    }

    private AppResult Run(params string[] arguments)
    {
        var (exitCode, output, error) = AppInProcess.Run(_folder.Path, arguments);
        return new(exitCode, output, error.ReplaceLineEndings("\n"));
    }
}
