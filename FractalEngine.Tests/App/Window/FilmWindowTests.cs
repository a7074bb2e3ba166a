using FractalEngine.Core.Scenes.Films;
using FractalEngine.Parsing;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.App.Window;

/// <summary>Tests films in a window: Space plays them, and keys are added to them.</summary>
[Collection(DrivenWindow.Collection)]
public sealed class FilmWindowTests : IDisposable
{
    private readonly TemporaryFolder _folder = new();

    public FilmWindowTests()
    {
        _folder.Write("cube.obj", "mtllib missing.mtl\nusemtl missing\n" + SampleFiles.Cube);
        _folder.Write("arms.fdo", "lean = 10 from 0 to 90\na. ((0, 1, 0), (0, 0, lean), (0.5))\nz<box>. [#, a.] box\n<$>. z 3\n");
        _folder.Write(
            "film.sdo",
            """
            c (0, 0, -9) # 60
            film 0.75
            o "arms.fdo" #
            o "cube.obj" ((-2, 0, 0), #, #)
            # The camera ends far away.
            at 0 c (0, 0.5, -5) # 60
            at 0.75 c (9, 0.5, -30) # 60
            at 0 lean = 0
            at 0.75 lean = 90

            """);
    }

    public void Dispose() => _folder.Dispose();

    [SkippableFact]
    public void Window_WithAFilm_PlaysItAndWritesAKeyAtItsTime()
    {
        using var window = Open();
        var start = window.Screenshot();
        window.Send("key space");
        Polling.WaitUntil(() => Settles(window), "end of the film");
        var end = window.Screenshot();
        Assert.True(DrivenWindow.DifferingFraction(start, end) > 0.01, "the film changed nothing");
        window.Send("key space");
        Polling.WaitUntil(() => DrivenWindow.DifferingFraction(end, window.Screenshot()) > 0.001, "first frame of the film again");
        Polling.WaitUntil(() => Settles(window), "end of the film again");
        Assert.Equal(0, DrivenWindow.DifferingFraction(end, window.Screenshot()));

        window.Send("key 1");
        Polling.WaitUntil(() => DrivenWindow.DifferingFraction(end, window.Screenshot()) > 0.001, "another view");
        window.ClickText("Edit");
        window.ClickText("Add a key");
        window.ClickText("Physics");
        window.ClickText("Stop the film");
        Polling.WaitUntil(() => DrivenWindow.DifferingFraction(start, window.Screenshot()) == 0, "view and numbers of the file");

        window.Send("key ctrl+s");
        window.WaitForError("saved film.sdo");
        var lines = File.ReadAllLines(_folder["film.sdo"]);
        Assert.Equal("c (0, 0, -9) # 60", lines[0]);
        Assert.Equal(("# The camera ends far away.", "at 0 c (0, 0.5, -5) # 60", "at 0 lean = 0"), (lines[4], lines[5], lines[7]));
        var film = SceneFile.Read(_folder["film.sdo"]).Film!;
        var key = Assert.IsType<CameraKey>(film.Keys[1]);
        Assert.Equal((0.75, 4), (key.Time, film.Keys.Length));
        Assert.NotEqual(9, key.Camera.Position.X);

        window.ClickText("View");
        window.ClickText("Film path");
        Polling.WaitUntil(() => DrivenWindow.DifferingFraction(start, window.Screenshot()) > 0.0005, "path as a line");
        Assert.Equal(0, window.CloseWith("key Escape"));
    }

    private DrivenWindow Open()
    {
        var window = DrivenWindow.Open(
            _folder, "film.sdo", "--gather", "1", "--no-shadows", "--no-ambient-occlusion");
        // The program warns of the missing file as soon as it shows the scene.
        window.WaitForError("missing.mtl");
        return window;
    }

    /// <summary>Whether nothing has changed for a moment: a film that plays changes each frame.</summary>
    private static bool Settles(DrivenWindow window)
    {
        var image = window.Screenshot();
        return Enumerable.Range(0, 3).All(_ => DrivenWindow.DifferingFraction(image, window.Screenshot()) == 0);
    }
}
