using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.App;

/// <summary>Tests which files of a folder <c>check</c> reads, and in which order.</summary>
[Collection(ConsoleTests.Name)]
public sealed class CheckFolderTests : IDisposable
{
    private readonly TemporaryFolder _folder = new();

    public void Dispose() => _folder.Dispose();

    [Fact]
    public void Check_OfAFolder_ReadsAllKindsOfFilesInOrdinalOrder()
    {
        string[] read =
        [
            "in/E.SDO", "in/a.ply", "in/b.OBJ", "in/c.Stl", "in/d.fdo", "in/f.obj.GZ", "in/sub/deep/i.obj", "in/sub/h.obj",
        ];
        string[] others = ["in/g.txt", "in/m.mtl", "in/p.png", "in/x.gz", "in/sdo", "in/obj.bak"];
        foreach (string name in read.Concat(others))
        {
            _folder.Write(name, "?\n");
        }

        var (exitCode, output, error) = AppInProcess.Run(_folder.Path, "check", "in");
        Assert.Equal((1, ""), (exitCode, output));
        Assert.Equal(
            read,
            error.ReplaceLineEndings("\n").Split('\n').Where(static line => line.Contains(":1:1: error: ", StringComparison.Ordinal))
                .Select(static line => line[..line.IndexOf(':', StringComparison.Ordinal)]));
    }

    [Fact]
    public void Check_OfAFolderWithOtherFilesOnly_NamesIt()
    {
        _folder.Write("in/g.txt", "?\n");
        Assert.Equal(
            (2, "", "error: the folder in has no mesh, fractal or scene\n"), Shown(AppInProcess.Run(_folder.Path, "check", "in")));
    }

    /// <summary>A faulty file is worse than one over a limit, and that is worse than a good one.</summary>
    [Theory]
    [InlineData(0, "good.obj", "good.obj")]
    [InlineData(3, "good.obj", "deep.fdo")]
    [InlineData(3, "deep.fdo", "good.obj")]
    [InlineData(1, "faulty.obj", "deep.fdo")]
    [InlineData(1, "deep.fdo", "faulty.obj", "good.obj")]
    [InlineData(1, "both.sdo")]
    [InlineData(3, "limits.sdo")]
    public void Check_OfSeveralFiles_EndsWithTheWorst(int expected, params string[] files)
    {
        _folder.Write("good.obj", SampleFiles.Cube);
        _folder.Write("cube.obj", SampleFiles.Cube);
        _folder.Write("faulty.obj", "?\n");
        _folder.Write("deep.fdo", SampleFiles.Row("99999999"));
        _folder.Write("both.sdo", "o \"deep.fdo\" #\no \"faulty.obj\" #\n");
        _folder.Write("limits.sdo", "o \"deep.fdo\" #\n");
        Assert.Equal(expected, AppInProcess.Run(_folder.Path, ["check", .. files]).ExitCode);
    }

    private static (int ExitCode, string Output, string Error) Shown(AppResult result) =>
        (result.ExitCode, result.Output, result.Error.ReplaceLineEndings("\n"));
}
