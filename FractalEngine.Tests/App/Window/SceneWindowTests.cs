using FractalEngine.Benchmarks.Drawing;
using FractalEngine.Core.Images;
using FractalEngine.Parsing.Assets;
using FractalEngine.Parsing.Sdo;
using FractalEngine.Render.Tracing;
using FractalEngine.Render.Views;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.App.Window;

/// <summary>
/// Tests the window as users see it: a process on the display of the tests, driven with keys, mouse and resizes by xdotool.
/// </summary>
[Collection(DrivenWindow.Collection)]
public sealed class SceneWindowTests : IDisposable
{
    // The program warns of the missing file as soon as it shows the cube.
    private const string CubeWithAWarning = "mtllib missing.mtl\nusemtl missing\n" + SampleFiles.Cube;
    private const string Warning = "missing.mtl";

    private const string Scene = "# kept\nc (2, 1.5, -3) (0.3, 0.6, 0) 60\n# kept too\no \"cube.obj\" #\n";

    private readonly TemporaryFolder _folder = new();

    public SceneWindowTests()
    {
        _folder.Write("cube.obj", CubeWithAWarning);
        _folder.Write("scene.sdo", Scene);
    }

    public void Dispose() => _folder.Dispose();

    [SkippableFact]
    public void Window_DrivenByKeysAndMouse_MovesSavesAndCloses()
    {
        using var window = Open("scene.sdo");
        var start = window.Screenshot();
        Assert.Equal((640, 480), (start.Width, start.Height));

        window.Send("key 3");
        var fromTheRight = window.Screenshot();
        Assert.True(DifferingFraction(start, fromTheRight) > 0.01, "the key 3 changed nothing");

        window.Send("mousemove --window {window} 300 240 mousedown 1 mousemove_relative 60 25 mousemove_relative 60 25 mouseup 1");
        var orbited = window.Screenshot();
        Assert.True(DifferingFraction(fromTheRight, orbited) > 0.01, "the drag changed nothing");

        window.Send("click 5 click 5 click 5");
        var zoomed = window.Screenshot();
        Assert.True(DifferingFraction(orbited, zoomed) > 0.01, "the wheel changed nothing");

        window.Send("key w key w");
        Assert.True(DifferingFraction(zoomed, window.Screenshot()) > 0.01, "the key W changed nothing");

        window.Send("windowsize --sync {window} 400 300");
        var resized = window.Screenshot();
        Assert.Equal((400, 300), (resized.Width, resized.Height));

        window.Send("key Return key 5");
        Assert.True(DifferingFraction(resized, window.Screenshot()) > 0.01, "Enter and 5 changed nothing");

        window.Send("key ctrl+s");
        window.WaitForError("saved scene.sdo");
        var text = File.ReadAllText(_folder["scene.sdo"]);
        var lines = text.Split('\n');
        Assert.Equal(("# kept", "# kept too", "o \"cube.obj\" #"), (lines[0], lines[2], lines[3]));
        Assert.StartsWith("projection orthographic ", lines[4], StringComparison.Ordinal);
        // Enter has returned to the camera of the file, so its line is unchanged.
        Assert.Equal(Scene.Split('\n')[1], lines[1]);
        Assert.NotNull(SceneParser.Parse(new("scene.sdo", text)).Scene.Camera);

        Assert.Equal(0, window.CloseWith("key Escape"));
    }

    [SkippableFact]
    public void Window_KeyL_ShowsTheHighlightOfALargeFace()
    {
        _folder.Write("shiny.mtl", "newmtl shiny\nKd 0 0 0\nKs 1 1 1\nNs 30\n");
        _folder.Write(
            "shiny.obj", "mtllib missing.mtl\nmtllib shiny.mtl\nv -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nusemtl shiny\nf 1 4 3 2\n");
        _folder.Write("shiny.sdo", "c (0, 0, -3) (0, 0, 0) 50\nlight point (0, 0, -1) (1, 1, 1) 1 10\no \"shiny.obj\" #\n");
        using var window = Open("shiny.sdo");
        var atVertices = window.Screenshot();
        window.Send("key l");
        Assert.True(DifferingFraction(atVertices, window.Screenshot()) > 0.01, "the key L changed nothing");
        Assert.Equal(0, window.CloseWith("key Escape"));
    }

    [SkippableFact]
    public void Window_OfBodies_PausesStepsResetsDropsAndWalks()
    {
        _folder.Write("fall.sdo",
            """
            c (0, 1, -6) (0, 0, 0) 60
            o "cube.obj" ((0, -1, 0), #, (8, 1, 8))
            p "cube.obj" ((0, 3, 0), #, #) 1 colour (1, 0, 0)
            player (2, 1, -2) 0.3 1.6

            """);
        using var window = OpenInLowQuality("fall.sdo");
        // The simulation runs from the beginning, and the body bounces for ever in front of the camera, until Space pauses it.
        var running = window.Screenshot();
        Polling.WaitUntil(() => DifferingFraction(running, window.Screenshot()) > 0.01, "moving body");
        window.Send("key space");
        var paused = window.Screenshot();
        for (var turn = 0; turn < 10; turn++)
        {
            // The program's loop makes the steps that are due before each screenshot.
            Assert.Equal(0, DifferingFraction(paused, window.Screenshot()));
        }

        window.Send("key r");
        var start = window.Screenshot();
        // After 0.7 s the body has fallen by 2.6, and is at the floor.
        window.Send(string.Join(' ', Enumerable.Repeat("key n", 44)));
        Assert.True(DifferingFraction(start, window.Screenshot()) > 0.01, "44 steps changed nothing");

        window.Send("key r");
        Assert.Equal(0, DifferingFraction(start, window.Screenshot()));

        window.Send("key b");
        Assert.True(DifferingFraction(start, window.Screenshot()) > 0.001, "the key B changed nothing");

        window.Send("key r key p");
        // The player walks as soon as its colliders are built.
        Polling.WaitUntil(() => DifferingFraction(start, window.Screenshot()) > 0.01, "view of the player after key P");

        // Walking has moved the camera, so that closing asks.
        window.Send("key p");
        Assert.Equal(0, window.CloseWith("key Escape key d"));
    }

    [SkippableFact]
    public void Undo_AfterAWalk_ReturnsToTheViewBeforeIt()
    {
        _folder.Write("floor.sdo",
            """
            c (0, 1, -6) (0, 0, 0) 60
            o "cube.obj" ((0, -1, 0), #, (8, 1, 8))
            player (2, 1, -2) 0.3 1.6

            """);
        using var window = OpenInLowQuality("floor.sdo");
        window.Send("key 3");
        var fromTheRight = window.Screenshot();
        window.Send("key p");
        window.Send("key p");
        Assert.True(DifferingFraction(fromTheRight, window.Screenshot()) > 0.01, "the walk did not move the camera");
        window.Send("key ctrl+z");
        Assert.Equal(0, DifferingFraction(fromTheRight, window.Screenshot()));
        Assert.Equal(0, window.CloseWith("key Escape key d"));
    }

    /// <summary>
    /// That nothing happens can't be waited for: this test waits for seconds, and measures the processor time of the program.
    /// </summary>
    [SkippableFact]
    public void Window_WithoutChanges_Sleeps()
    {
        using var window = Open("scene.sdo");
        window.Screenshot();
        // Frames are gathered first.
        Polling.WaitUntil(() => CoreFraction(window, TimeSpan.FromSeconds(0.25)) < 0.05, "the rest");
        // The message of the screenshot is shown for four seconds, then one more frame is presented.
        AssertSleeps(window, TimeSpan.FromSeconds(4.5));
        AssertSleeps(window, TimeSpan.FromSeconds(2));
        Assert.Equal(0, window.CloseWith("key Escape"));
    }

    [SkippableFact]
    public void Window_WithTrace_ConvergesToTheTracedImageAndReturnsToTheFrameOnAMove()
    {
        // Only light that is traced throws a shadow.
        _folder.Write("shadow.sdo",
            """
            o "cube.obj" ((0, -1, 0), #, (6, 0.2, 6))
            o "cube.obj" ((0, 1, 0), #, #)
            light directional (1, -1, 0.5) (1, 1, 1) 0.8
            light ambient (1, 1, 1) 0.2

            """);
        using var window = DrivenWindow.Open(_folder, "shadow.sdo", "--trace", "2", "--resolution", "320x240");
        window.WaitForTitle("shadow.sdo, traced 2 of 2 - FractalEngine");
        var traced = window.Screenshot();
        var scene = AssetLoader.Load(_folder["shadow.sdo"]).Scene;
        var tracer = new PathTracer(scene, View.Of(scene, 320.0 / 240), 320, 240) { CanDenoise = true };
        for (var i = 0; i < 2; i++)
        {
            tracer.AddSample();
        }

        Assert.InRange(ImageError.PeakSignalToNoiseRatio(traced, tracer.Denoise()), 40, double.PositiveInfinity);
        // The message of the screenshot is shown for four seconds, then one more frame is presented.
        Thread.Sleep(TimeSpan.FromSeconds(4.5));
        AssertSleeps(window, TimeSpan.FromSeconds(2));

        // Wireframes are drawn, and so is the frame of a view that has just been left.
        window.Send("key x");
        window.WaitForTitle("not traced: wireframe");
        window.Send("key x key 7");
        window.WaitForTitle("traced 2 of 2");
        var moved = window.Screenshot();
        Assert.True(DifferingFraction(traced, moved) > 0.01, "the camera did not move");
        window.Send("key y");
        window.WaitForTitle("shadow.sdo - FractalEngine");
        var drawn = window.Screenshot();
        Assert.True(DifferingFraction(moved, drawn) > 0.01, "the traced image stays");
        window.Send("key y");
        window.WaitForTitle("traced 2 of 2");
        Assert.Equal(0, DifferingFraction(moved, window.Screenshot()));
        Assert.Equal(0, window.CloseWith("key Escape key d"));
    }

    [SkippableFact]
    public void View_OpenedPlainly_IsTracedUntilTheUserSwitchesThatOff()
    {
        _folder.Write("ball.sdo", "o \"cube.obj\" ((0, 0, 0), #, #)\nlight ambient (1, 1, 1) 0.2\n");
        using (var window = DrivenWindow.OpenPlainly(_folder, "ball.sdo"))
        {
            window.WaitForTitle("ball.sdo, traced ");
            window.Send("key y");
            window.WaitForTitle("ball.sdo - FractalEngine");
            Assert.Equal(0, window.CloseWith("key Escape"));
        }

        using (var window = DrivenWindow.OpenPlainly(_folder, "ball.sdo"))
        {
            window.WaitForTitle("ball.sdo - FractalEngine");
            window.Send("key y");
            window.WaitForTitle("ball.sdo, traced ");
            Assert.Equal(0, window.CloseWith("key Escape"));
        }
    }

    [SkippableFact]
    public void Window_OnABadFile_ShowsTheErrorAndExitsWith1()
    {
        _folder.Write("bad.sdo", "o \"cube.obj\" (\n");
        using var window = DrivenWindow.Open(_folder, "bad.sdo");
        window.WaitForError("bad.sdo:1:");
        Assert.Equal(1, window.CloseWith("key Escape"));
    }

    private DrivenWindow Open(string file) => WaitForCube(DrivenWindow.Open(_folder, file));

    private DrivenWindow OpenInLowQuality(string file) => WaitForCube(DrivenWindow.OpenInLowQuality(_folder, file));

    private static DrivenWindow WaitForCube(DrivenWindow window)
    {
        window.WaitForError(Warning);
        return window;
    }

    private static double DifferingFraction(PixelImage image1, PixelImage image2) => DrivenWindow.DifferingFraction(image1, image2);

    private static double CoreFraction(DrivenWindow window, TimeSpan duration)
    {
        var before = window.ProcessorTime;
        Thread.Sleep(duration);
        return (window.ProcessorTime - before) / duration;
    }

    private static void AssertSleeps(DrivenWindow window, TimeSpan duration)
    {
        var coreFraction = CoreFraction(window, duration);
        // A loop that draws or polls takes a whole core, and waiting for events almost nothing. The limit allows for a noisy machine.
        Assert.True(coreFraction < 0.15, $"an idle window took {coreFraction:P0} of a core");
    }
}
