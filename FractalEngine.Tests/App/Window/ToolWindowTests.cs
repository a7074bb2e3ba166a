using FractalEngine.Core.Images;
using FractalEngine.Core.Maths;
using FractalEngine.Parsing.Assets;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.App.Window;

/// <summary>Tests sections, handles and the numbers of panels in the window as a process, driven by xdotool.</summary>
[Collection("GL")]
public sealed class ToolWindowTests : IDisposable
{
    private const string Scene =
        """
        # kept
        c (0, 0, -8) (0, 0, 0) 60
        o "cube.obj" ((0, 0, 0), #, #) name "left" colour (0.8, 0.3, 0.2)
        # between
        o "cube.obj" ((3, 0, 0), #, #) name "right"

        """;

    private readonly TemporaryFolder _folder = new();

    public ToolWindowTests()
    {
        _folder.Write("cube.obj", "mtllib missing.mtl\nusemtl missing\n" + SampleFiles.Cube);
        _folder.Write("scene.sdo", Scene.Replace("\r", "", StringComparison.Ordinal));
        _folder.Write(
            "row.fdo", "v 1.5 0 0\nv 0.5 0.5 0.5\nv 2 0 0\nt.a.b. (a, #, b)\nx. \"cube.obj\"\nz<x>. [#, t.1.2] x\n<$>. z 3\n");
    }

    public void Dispose() => _folder.Dispose();

    [SkippableFact]
    public void Section_ByKeysAndDragged_CutsTheFrame()
    {
        using var window = Open("scene.sdo");
        var whole = window.Screenshot();
        // Through the middle of both cubes, towards the eye; they are filled.
        window.Send("key k");
        var cut = window.Screenshot();
        Assert.True(DrivenWindow.DifferingFraction(whole, cut) > 0.005);
        // The other side.
        window.Send("key ctrl+k");
        Assert.True(DrivenWindow.DifferingFraction(cut, window.Screenshot()) > 0.005);
        window.Send("key ctrl+k");
        Assert.Equal(0, DrivenWindow.DifferingFraction(cut, window.Screenshot()));
        // Hollow, and filled again.
        window.Send("key ctrl+shift+k");
        Assert.True(DrivenWindow.DifferingFraction(cut, window.Screenshot()) > 0.002);
        window.Send("key ctrl+shift+k");
        Assert.Equal(0, DrivenWindow.DifferingFraction(cut, window.Screenshot()));
        // The knob is in the middle of the scene. Looking along the normal, upwards comes nearer: the cubes are whole again.
        var (x, y) = window.FindText("↔");
        Drag(window, x, y, x, y - 120);
        Polling.WaitUntil(() => DrivenWindow.DifferingFraction(whole, window.Screenshot()) == 0, "whole cubes");
        Drag(window, x, y, x, y + 240);
        Polling.WaitUntil(() => DrivenWindow.DifferingFraction(whole, window.Screenshot()) > 0.01, "cubes that are gone");
        window.Send("key k");
        Assert.Equal(0, DrivenWindow.DifferingFraction(whole, window.Screenshot()));
        // A section is no change of the file.
        Assert.Equal(0, window.CloseWith("key Escape"));
    }

    [SkippableFact]
    [Trait("Category", "Soak")]
    public void Section_InThePanel_TurnsMovesAndIsTakenFromTheCommandLine()
    {
        PixelImage expected;
        using (var window = DrivenWindow.Open(_folder, "scene.sdo", "--section", "1,0,0,0.25"))
        {
            window.WaitForError("missing.mtl");
            expected = window.Screenshot();
            Assert.Equal(0, window.CloseWith("key Escape"));
        }

        using var other = Open("scene.sdo");
        other.Send("key F3 key k");
        other.FindText("distance");
        // Across the x axis, at a distance that is typed.
        other.ClickText("Flip", right: -210);
        other.ClickText("distance", right: 120);
        other.Send("key ctrl+a");
        other.Type("0.25");
        other.Send("key Return");
        Polling.WaitUntil(() => DrivenWindow.DifferingFraction(expected, other.Screenshot()) == 0, "the section of the command line");
        other.ClickText("Flip");
        Polling.WaitUntil(() => DrivenWindow.DifferingFraction(expected, other.Screenshot()) > 0.005, "the other side");
        other.ClickText("Flip", right: -140);
        other.ClickText("Flip", right: -70);
        other.ClickText("Filled");
        other.ClickText("Section");
        Assert.Equal(0, other.CloseWith("key Escape"));
    }

    [SkippableFact]
    public void Handles_Dragged_MoveTheObjectInTheFileAndCanBeUndone()
    {
        using var window = Open("scene.sdo");
        SelectLeft(window);
        window.Send("key 2");
        var (x, y) = FindHandle(window, "x");
        Drag(window, x, y, x + 60, y);
        window.WaitForTitle("scene.sdo*");
        window.Send("key ctrl+z");
        window.WaitForTitle("scene.sdo -");
        window.Send("key ctrl+shift+z");
        window.WaitForTitle("scene.sdo*");
        window.Send("key ctrl+s");
        window.WaitForError("saved scene.sdo");
        var (position, rotation, scale) = LeftPlacement();
        Assert.InRange(position.X, 0.7, 1.4);
        Assert.Equal((0, 0), (position.Y, position.Z));
        Assert.Equal((Vector.Zero, Vector.One), (rotation, scale));
        Assert.StartsWith("# kept\nc (0, 0, -8) (0, 0, 0) 60\n", Text(), StringComparison.Ordinal);
        Assert.Contains("\n# between\n", Text(), StringComparison.Ordinal);
        Assert.Equal(0, window.CloseWith("key Escape key Escape"));
    }

    [SkippableFact]
    [Trait("Category", "Soak")]
    public void Handles_WithCtrl_SnapInAllModes()
    {
        using var window = Open("scene.sdo");
        SelectLeft(window);
        window.Send("key 2");
        var (x, y) = FindHandle(window, "y");
        Drag(window, x, y, x, y - 43, "ctrl");
        Save(window);
        var moved = LeftPlacement().Position;
        Assert.Equal(Math.Round(moved.Y), moved.Y, 1e-9);
        Assert.True(moved.Y >= 1);
        // In the plane of the frame.
        (x, y) = FindHandle(window, "o");
        Drag(window, x, y, x - 50, y + 60);
        Save(window);
        Assert.True(LeftPlacement().Position.X < -0.3 && LeftPlacement().Position.Y < moved.Y - 0.3);
        // Turned about z by whole steps of 15 degrees.
        window.Send("key 4");
        (x, y) = FindHandle(window, "z");
        Drag(window, x, y, x - 10, y - 60, "ctrl");
        Save(window);
        var rotation = LeftPlacement().Rotation;
        Assert.Equal((0.0, 0.0), (rotation.X, rotation.Y));
        Assert.True(Math.Abs(rotation.Z) >= 15 && Math.Abs(Math.IEEERemainder(rotation.Z, 15)) < 1e-9, $"turned by {rotation}");
        // Scaled along its own x by tenths, then as a whole.
        window.Send("key 6");
        var before = LeftPlacement().Position;
        (x, y) = FindHandle(window, "o");
        Drag(window, x, y, x + 40, y, "ctrl");
        Save(window);
        var scale = LeftPlacement().Scale;
        Assert.True(scale.X > 1.2 && scale.X == scale.Y && scale.Y == scale.Z, $"scaled by {scale}");
        Assert.Equal(Math.Round(scale.X, 1), scale.X, 1e-9);
        Assert.Equal(before, LeftPlacement().Position);
        window.Send("key 6");
        Assert.False(window.ShowsText("Ctrl snaps"));
        Assert.Equal(0, window.CloseWith("key Escape key Escape"));
    }

    [SkippableFact]
    [Trait("Category", "Soak")]
    public void SelectionPanel_TypedNumbers_PlaceTheObject()
    {
        using var window = Open("scene.sdo");
        window.Send("key F6");
        SelectLeft(window);
        window.FindText("Handles");
        // The panel covers the object, not its numbers.
        window.Send("key 2");
        TypeAt(window, "position", 0, 23, "-1.25");
        TypeAt(window, "rotation in degrees", -60, 23, "30");
        TypeAt(window, "scale", 10, 23, "2");
        Save(window);
        var (position, rotation, scale) = LeftPlacement();
        Assert.Contains(-1.25, new[] { position.X, position.Y, position.Z });
        Assert.Contains(30, new[] { rotation.X, rotation.Y, rotation.Z });
        Assert.Contains(2, new[] { scale.X, scale.Y, scale.Z });
        window.Send("key ctrl+z key ctrl+z key ctrl+z");
        window.WaitForTitle("scene.sdo*");
        Save(window);
        Assert.Equal(Transformation.Identity, new(LeftPlacement().Position, LeftPlacement().Rotation, LeftPlacement().Scale));
        Assert.Equal(0, window.CloseWith("key Escape key Escape"));
    }

    [SkippableFact]
    [Trait("Category", "Soak")]
    public void ScenePanel_SkyHazeAndCamera_AreSavedInTheirLines()
    {
        using var window = DrivenWindow.Open(_folder, "scene.sdo", "--resolution", "900x700");
        window.WaitForError("missing.mtl");
        var before = window.Screenshot();
        window.Send("key F2");
        window.ClickText("Sky and haze");
        window.ClickText("sky", right: 30);
        Polling.WaitUntil(() => DrivenWindow.DifferingFraction(before, window.Screenshot()) > 0.5, "a sky");
        window.FindText("zenith");
        window.ClickText("filmic tone");
        TypeAt(window, "exposure", 120, 0, "1.5");
        TypeAt(window, "haze", 120, 0, "0.05");
        Save(window);
        Assert.Contains("\nsky ", Text(), StringComparison.Ordinal);
        Assert.Contains("\nexposure 1.5\n", Text(), StringComparison.Ordinal);
        Assert.Contains("\ntone filmic\n", Text(), StringComparison.Ordinal);
        Assert.Contains("\nfog 0.05\n", Text(), StringComparison.Ordinal);
        window.ClickText("sky", right: 30);
        Save(window);
        Assert.DoesNotContain("\nsky ", Text(), StringComparison.Ordinal);
        window.ClickText("Sky and haze");
        window.ClickText("Camera");
        TypeAt(window, "rotation in degrees", -60, 23, "10");
        Save(window);
        Assert.DoesNotContain("c (0, 0, -8) (0, 0, 0) 60", Text(), StringComparison.Ordinal);
        Assert.Equal(0, window.CloseWith("key Escape key Escape"));
    }

    [SkippableFact]
    [Trait("Category", "Soak")]
    public void ViewPanel_ClipPlanesAndNormals_AreShownAndSaved()
    {
        using var window = DrivenWindow.Open(_folder, "scene.sdo", "--resolution", "900x700");
        window.WaitForError("missing.mtl");
        var before = window.Screenshot();
        window.Send("key F3");
        window.ClickText("Normals");
        Polling.WaitUntil(() => DrivenWindow.DifferingFraction(before, window.Screenshot()) > 0.0001, "normals");
        window.ClickText("Normals");
        Polling.WaitUntil(() => DrivenWindow.DifferingFraction(before, window.Screenshot()) == 0, "no normals");
        window.ClickText("Fixed clip planes");
        TypeAt(window, "near", 60, 0, "8");
        Polling.WaitUntil(() => DrivenWindow.DifferingFraction(before, window.Screenshot()) > 0.001, "clipped cubes");
        Save(window);
        Assert.Contains("\nclip 8 ", Text(), StringComparison.Ordinal);
        window.ClickText("Fixed clip planes");
        Save(window);
        Assert.DoesNotContain("\nclip ", Text(), StringComparison.Ordinal);
        Polling.WaitUntil(() => DrivenWindow.DifferingFraction(before, window.Screenshot()) == 0, "whole cubes");
        Assert.Equal(0, window.CloseWith("key Escape"));
    }

    [SkippableFact]
    [Trait("Category", "Soak")]
    public void FractalPanel_ArgumentOfACall_TakesAnotherVector()
    {
        using var window = Open("row.fdo");
        var before = window.Screenshot();
        window.Send("key F4");
        TypeAt(window, "call t 1: vectors", -70, 23, "3");
        Polling.WaitUntil(() => DrivenWindow.DifferingFraction(before, window.Screenshot()) > 0.003, "another position");
        Save(window, "row.fdo");
        Assert.Contains("z<x>. [#, t.3.2] x", File.ReadAllText(_folder["row.fdo"]), StringComparison.Ordinal);
        // There is no vector 9: the largest number counts.
        TypeAt(window, "call t 1: vectors", -70, 23, "9");
        window.Send("key ctrl+z");
        window.WaitForTitle("row.fdo -");
        Assert.Equal(0, window.CloseWith("key Escape"));
    }

    private static void Drag(DrivenWindow window, int x, int y, int toX, int toY, string? key = null)
    {
        // In steps, as a hand does.
        window.Send($"mousemove --window {{window}} {x} {y} mousedown 1");
        window.Send(key is null ? "sleep 0.01" : $"keydown {key}");
        for (var i = 1; i <= 4; i++)
        {
            window.Send($"mousemove --window {{window}} {x + ((toX - x) * i / 4)} {y + ((toY - y) * i / 4)}");
        }

        window.Send("mouseup 1");
        window.Send(key is null ? "sleep 0.01" : $"keyup {key}");
    }

    /// <summary>Selects the left cube, which is in the middle of the frame.</summary>
    private static void SelectLeft(DrivenWindow window) => window.Send("mousemove --window {window} 320 240 click 1");

    /// <summary>Finds a handle; the knobs of the axes, which have the same letters, stand above it.</summary>
    private static (int X, int Y) FindHandle(DrivenWindow window, string label) => window.FindText(label);

    private static void TypeAt(DrivenWindow window, string text, int right, int down, string number)
    {
        var (x, y) = window.FindText(text);
        window.Send($"mousemove --window {{window}} {x + right} {y + down} click 1");
        window.Send("key ctrl+a");
        window.Type(number);
        window.Send("key Return");
    }

    private void Save(DrivenWindow window, string file = "scene.sdo")
    {
        window.WaitForTitle(file);
        var count = window.CountErrors($"saved {file}");
        window.Send("key ctrl+s");
        Polling.WaitUntil(() => window.CountErrors($"saved {file}") > count, $"saved {file}");
    }

    private string Text() => File.ReadAllText(_folder["scene.sdo"]);

    private (Vector Position, Vector Rotation, Vector Scale) LeftPlacement()
    {
        var placement = AssetLoader.Load(_folder["scene.sdo"]).Scene.Scene.Objects[0].Placement;
        return (placement.Position, placement.Rotation, placement.Scale);
    }

    private DrivenWindow Open(string file)
    {
        var window = DrivenWindow.Open(_folder, file);
        window.WaitForError("missing.mtl");
        return window;
    }
}
