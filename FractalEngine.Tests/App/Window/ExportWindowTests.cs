using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.App.Window;

/// <summary>Exports from a driven window, where the command is the oracle.</summary>
[Collection(DrivenWindow.Collection)]
public sealed class ExportWindowTests : IDisposable
{
    private const string Numbers = "levels = 2 from 1 to 6\n";
    private const string Cube = "mtllib missing.mtl\nusemtl missing\n" + SampleFiles.Cube;

    private readonly TemporaryFolder _folder = new();

    public ExportWindowTests()
    {
        _folder.Write("cube.obj", Cube);
        _folder.Write("row.fdo", Numbers + SampleFiles.Row("(levels)"));
    }

    public void Dispose() => _folder.Dispose();

    /// <summary>The fractal has a number that was changed in the window, and not saved.</summary>
    [SkippableTheory]
    [InlineData("row.obj", "row.glb", "row.html", "few.csv --instances 2")]
    public void Export_OfAnEditedFractal_EqualsThatOfTheCommand(params string[] outputs)
    {
        using var window = Open("row.fdo");
        window.Send("key F4");
        window.ClickText("levels", right: 90);
        window.Send("key ctrl+a key 4 key Return");
        window.WaitForTitle("row.fdo*");
        Polling.WaitUntil(() => window.ShowsText("192 faces"), "the fractal at the other number");
        foreach (var output in outputs)
        {
            window.Send("key ctrl+e key ctrl+u");
            window.Type(output);
            window.Send("key Return");
            window.WaitForError($"saved {output.Split(' ')[0]}: ");
        }

        Assert.Equal(0, window.CloseWith("key Escape key d"));
        _folder.Write("command/cube.obj", Cube);
        _folder.Write("command/row.fdo", Numbers.Replace("= 2", "= 4", StringComparison.Ordinal) + SampleFiles.Row("(levels)"));
        foreach (var output in outputs)
        {
            string[] words = output.Split(' ');
            Assert.Equal(0, AppProcess.Run(Path.Combine(_folder.Path, "command"), ["export", "row.fdo", "--output", .. words]).ExitCode);
            Assert.Equal(File.ReadAllBytes(_folder[$"command/{words[0]}"]), File.ReadAllBytes(_folder[words[0]]));
        }
    }

    [SkippableTheory]
    [InlineData("row.ply", "row.stl --height 80mm", "row.3mf --flat", "whole.3mf", "row.csv --up z", "welded.obj --weld --no-materials")]
    [Trait("Category", "Soak")]
    public void Export_OfAnEditedFractalInOtherFormats_EqualsThatOfTheCommand(params string[] outputs) =>
        Export_OfAnEditedFractal_EqualsThatOfTheCommand(outputs);

    [SkippableTheory]
    [InlineData(false)]
    [InlineData(true)]
    public void Export_ThatIsStopped_LeavesNothing(bool isClosed)
    {
        _folder.Write("big.fdo", SampleFiles.Row("21"));
        using var window = Open("big.fdo");
        var files = Directory.GetFiles(_folder.Path, "big*");
        window.Send("key ctrl+e");
        // The slowest format, so that it is not written before the click.
        window.Type(".3mf --flat");
        window.Send("key Return");
        var (x, y) = window.FindText("Stop");
        Assert.NotEqual(files, Directory.GetFiles(_folder.Path, "big*"));
        if (!isClosed)
        {
            window.Send(FormattableString.Invariant($"mousemove --window {{window}} {x} {y} click 1"));
            window.WaitForError("Export: stopped, and nothing is written");
        }

        Assert.Equal(0, window.CloseWith("key Escape"));
        Assert.Equal(files, Directory.GetFiles(_folder.Path, "big*"));
    }

    private DrivenWindow Open(string file)
    {
        var window = DrivenWindow.OpenInLowQuality(_folder, file);
        window.WaitForError("missing.mtl");
        return window;
    }
}
