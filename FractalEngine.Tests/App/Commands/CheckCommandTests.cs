using System.Globalization;
using System.Text;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.App.Commands;

/// <summary>Tests that <c>check</c> tells all errors of a scene.</summary>
[Collection(ConsoleTests.Name)]
public sealed class CheckCommandTests : IDisposable
{
    private readonly TemporaryFolder _folder = new();

    public CheckCommandTests() => _folder.Write("cube.obj", SampleFiles.Cube);

    public void Dispose() => _folder.Dispose();

    [Fact]
    public void Check_OfASceneWithManyMistakes_TellsThemAll()
    {
        _folder.Write("broken.obj", "v 1 2\n");
        _folder.Write("bad.sdo", """
            o "cube.obj" #
            x y
            o "cube.obj" # name "a" nonsense
            light directional (1, 1, 1) (1, 1, 1) 1 rest
            o "missing.obj" #
            c (0, 0, 0) (0, 0, 0) 400
            o "broken.obj" #

            """);
        var (exitCode, output, error) = Run("check", "bad.sdo");
        Assert.Equal((1, ""), (exitCode, output));
        Assert.Equal(
            ["bad.sdo:2:1", "bad.sdo:3:25", "bad.sdo:4:41", "bad.sdo:6:23", "bad.sdo:5:3", "broken.obj:1:6"],
            error.Split('\n').Where(line => line.Contains(": error: ", StringComparison.Ordinal))
                .Select(line => line[..line.IndexOf(": error", StringComparison.Ordinal)]));
    }

    /// <summary>A line that is faulty at its end declares nothing, so that the places of the files behind it stay right.</summary>
    [Fact]
    public void Check_BehindAFaultyObject_NamesTheRightLine()
    {
        _folder.Write("bad.sdo", "o \"cube.obj\" # nonsense\no \"missing.obj\" #\n");
        Assert.Contains("bad.sdo:2:3: error: the file \"missing.obj\" is not found", Run("check", "bad.sdo").Error);
    }

    [Fact]
    public void Check_OfThousandsOfMistakes_EndsAfterAHundred()
    {
        var text = new StringBuilder();
        for (var i = 0; i < 5000; i++)
        {
            text.Append(CultureInfo.InvariantCulture, $"mistake {i}\n");
        }

        _folder.Write("bad.sdo", text.ToString());
        var (exitCode, _, error) = Run("check", "bad.sdo");
        Assert.Equal((1, 100), (exitCode, error.Split('\n').Count(line => line.Contains(": error: ", StringComparison.Ordinal))));
        Assert.Contains("(after 100 faulty lines the rest is not read)", error, StringComparison.Ordinal);
    }

    /// <summary>Other commands need the first error alone.</summary>
    [Fact]
    public void Info_OfASceneWithManyMistakes_TellsTheFirst()
    {
        _folder.Write("bad.sdo", "x\ny\n");
        Assert.Single(Run("info", "bad.sdo").Error.Split('\n'), line => line.Contains(": error: ", StringComparison.Ordinal));
    }

    private AppResult Run(params string[] arguments) => AppInProcess.Run(_folder.Path, arguments);
}
