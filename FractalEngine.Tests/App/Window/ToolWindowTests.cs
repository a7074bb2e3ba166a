using FractalEngine.Core.Images;
using FractalEngine.Core.Maths;
using FractalEngine.Parsing.Assets;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.App.Window;

/// <summary>Tests sections, handles and the numbers of panels in the window as a process, driven by xdotool.</summary>
[Collection(DrivenWindow.Collection)]
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
        var (x, y) = At(1.5, 0);
        Drag(window, x, y, x, y - 100);
        Polling.WaitUntil(() => DrivenWindow.DifferingFraction(whole, window.Screenshot()) == 0, "whole cubes");
        window.Send("key ctrl+k");
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
        var expected = Draw("--section", "1,0,0,0.25");
        using var other = OpenLarge(size: "640x680");
        other.Send("key F3 key k");
        // Across the x axis, at a distance that is typed.
        other.ClickText("Flip", right: -210);
        MoveAway(other);
        TypeAt(other, "distance", 120, 0, "0.25");
        Polling.WaitUntil(() => DrivenWindow.DifferingFraction(expected, other.Screenshot()) == 0, "the section of the command line");
        Click(other, "Flip");
        Polling.WaitUntil(() => DrivenWindow.DifferingFraction(expected, other.Screenshot()) > 0.005, "the other side");
        other.ClickText("Flip", right: -140);
        MoveAway(other);
        other.ClickText("Flip", right: -70);
        MoveAway(other);
        Click(other, "Filled");
        Assert.Equal(0, other.CloseWith("key Escape key Escape"));
    }

    [SkippableFact]
    public void Handles_Dragged_MoveTheObjectInTheFileAndCanBeUndone()
    {
        using var window = Open("scene.sdo");
        Select(window, 0, 0);
        window.Send("key 2");
        var (x, y) = At(0, 0);
        Drag(window, x + Reach, y, x + Reach + 60, y);
        window.WaitForTitle("scene.sdo*");
        // One step, however many moves the drag had.
        window.Send("key ctrl+z");
        window.WaitForTitle("scene.sdo -");
        window.Send("key ctrl+shift+z");
        window.WaitForTitle("scene.sdo*");
        Save(window);
        var (position, rotation, scale) = LeftPlacement();
        Assert.InRange(position.X, 1.0, 1.3);
        Assert.Equal((0, 0), (position.Y, position.Z));
        Assert.Equal((Vector.Zero, Vector.One), (rotation, scale));
        Assert.StartsWith("# kept\nc (0, 0, -8) (0, 0, 0) 60\n", Text(), StringComparison.Ordinal);
        Assert.Contains("\n# between\n", Text(), StringComparison.Ordinal);
        // What is selected has moved along, and Esc lets go of it.
        Assert.Equal(0, window.CloseWith("key Escape key Escape"));
    }

    [SkippableFact]
    [Trait("Category", "Soak")]
    public void Handles_WithCtrl_SnapInAllModes()
    {
        using var window = Open("scene.sdo");
        Select(window, 0, 0);
        window.Send("key 2");
        var (x, y) = At(0, 0);
        Drag(window, x, y - Reach, x, y - Reach - 43, "ctrl");
        Save(window);
        Assert.Equal(new Vector(0, 1, 0), LeftPlacement().Position);
        // In the plane of the frame.
        (x, y) = At(0, 1);
        Drag(window, x, y, x - 52, y + 104);
        Save(window);
        Near.Equal(new Vector(-1, -1, 0), LeftPlacement().Position, 0.1);
        // About z, by whole steps of 15 degrees.
        window.Send("key 4");
        (x, y) = At(LeftPlacement().Position.X, LeftPlacement().Position.Y);
        Drag(window, x + Reach, y, x + 60, y - 60, "ctrl");
        Save(window);
        Assert.Equal(new Vector(0, 0, 45), LeftPlacement().Rotation.Absolute());
        // As a whole, by tenths, and along its own x.
        window.Send("key 6");
        var before = LeftPlacement().Position;
        (x, y) = At(before.X, before.Y);
        Drag(window, x, y, x + 40, y, "ctrl");
        Save(window);
        Assert.Equal(1.5 * Vector.One, LeftPlacement().Scale);
        Assert.Equal(before, LeftPlacement().Position);
        var axis = LeftPlacement().Rotation.LocalAxesFromDegrees().V1;
        var (right, down) = ((int)(Reach * axis.X), (int)(-Reach * axis.Y));
        Drag(window, x + right, y + down, x + (3 * right / 2), y + (3 * down / 2));
        Save(window);
        Assert.InRange(LeftPlacement().Scale.X, 2.1, 2.4);
        Assert.Equal((1.5, 1.5), (LeftPlacement().Scale.Y, LeftPlacement().Scale.Z));
        // The same key again: without handles a drag orbits.
        window.Send("key 6");
        Drag(window, x, y, x + 30, y);
        Save(window);
        Assert.DoesNotContain("c (0, 0, -8) (0, 0, 0) 60", Text(), StringComparison.Ordinal);
        Assert.Equal(0, window.CloseWith("key Escape key Escape key d"));
    }

    [SkippableFact]
    [Trait("Category", "Soak")]
    public void SelectionPanel_TypedNumbers_PlaceTheObject()
    {
        using var window = OpenLarge();
        window.Send("key F6");
        window.FindText("Distances");
        window.Send("mousemove --window {window} 302 350 click 1");
        window.ClickText("Move");
        MoveAway(window);
        TypeAt(window, "position", 23, 23, "-1.25");
        TypeAt(window, "rotation in degrees", -20, 23, "30");
        TypeAt(window, "scale", 35, 23, "2.5");
        Save(window);
        var (position, rotation, scale) = LeftPlacement();
        Assert.Equal((new Vector(-1.25, 0, 0), new Vector(30, 0, 0), new Vector(2.5, 1, 1)), (position, rotation, scale));
        // Three steps back.
        window.Send("key ctrl+z key ctrl+z key ctrl+z");
        window.WaitForTitle("scene.sdo*");
        Save(window);
        Assert.Equal((Vector.Zero, Vector.Zero, Vector.One), LeftPlacement());
        Assert.Equal(0, window.CloseWith("key Escape key Escape"));
    }

    [SkippableFact]
    [Trait("Category", "Soak")]
    public void ScenePanel_SkyHazeAndCamera_AreSavedInTheirLines()
    {
        using var window = OpenLarge();
        var before = window.Screenshot();
        window.Send("key F2");
        Click(window, "Sky and haze");
        Click(window, "filmic tone");
        TypeAt(window, "exposure", 120, 0, "1.5");
        TypeAt(window, "haze", 120, 0, "0.05");
        // The check box of the sky stands above.
        var (x, y) = window.FindText("exposure");
        window.Send($"mousemove --window {{window}} {x} {y - 23} click 1");
        MoveAway(window);
        window.FindText("zenith");
        Polling.WaitUntil(() => DrivenWindow.DifferingFraction(before, window.Screenshot()) > 0.5, "a sky");
        Save(window);
        Assert.Contains("\nsky ", Text(), StringComparison.Ordinal);
        Assert.Contains("\nexposure 1.5\n", Text(), StringComparison.Ordinal);
        Assert.Contains("\ntone filmic\n", Text(), StringComparison.Ordinal);
        Assert.Contains("\nfog 0.05\n", Text(), StringComparison.Ordinal);
        Click(window, "Sky and haze");
        Click(window, "Camera");
        TypeAt(window, "rotation in degrees", -20, 23, "10");
        Save(window);
        Assert.DoesNotContain("c (0, 0, -8) (0, 0, 0) 60", Text(), StringComparison.Ordinal);
        window.Send("key ctrl+z key ctrl+z");
        Assert.Equal(0, window.CloseWith("key Escape key d"));
    }

    [SkippableFact]
    [Trait("Category", "Soak")]
    public void ViewPanel_ClipPlanesAndNormals_AreShownAndSaved()
    {
        using var window = OpenLarge();
        var before = window.Screenshot();
        window.Send("key F3");
        Click(window, "Normals");
        Polling.WaitUntil(() => DrivenWindow.DifferingFraction(before, window.Screenshot()) > 0.0001, "normals");
        Click(window, "Normals");
        Polling.WaitUntil(() => DrivenWindow.DifferingFraction(before, window.Screenshot()) == 0, "no normals");
        Click(window, "Fixed clip planes");
        TypeAt(window, "near", 60, 0, "8");
        Polling.WaitUntil(() => DrivenWindow.DifferingFraction(before, window.Screenshot()) > 0.001, "clipped cubes");
        Save(window);
        Assert.Contains("\nclip 8 ", Text(), StringComparison.Ordinal);
        Click(window, "Fixed clip planes");
        Save(window);
        Assert.DoesNotContain("\nclip ", Text(), StringComparison.Ordinal);
        Polling.WaitUntil(() => DrivenWindow.DifferingFraction(before, window.Screenshot()) == 0, "whole cubes");
        // The first gives the keyboard back, which the check box has.
        Assert.Equal(0, window.CloseWith("key Escape key Escape"));
    }

    [SkippableFact]
    public void Normals_OfABodyThatFliesAway_FollowIt()
    {
        _folder.Write(
            "flight.sdo", "gravity (0, 0, 0)\nc (0, 0, -8) (0, 0, 0) 60\np \"cube.obj\" ((-2, 0, 0), #, #) 0 velocity (30, 0, 0)\n");
        using var window = OpenLarge("flight.sdo");
        Polling.WaitUntil(() => IsEmpty(window.Screenshot()), "a body out of sight");
        // Paused there.
        window.Send("key n key F3");
        Click(window, "Normals");
        Assert.True(IsEmpty(window.Screenshot()), "normals stay where the body began");
        // The first gives the keyboard back, which the check box has.
        window.Send("key Escape key r");
        var withNormals = window.Screenshot();
        Click(window, "Normals");
        Polling.WaitUntil(() => DrivenWindow.DifferingFraction(withNormals, window.Screenshot()) > 0.0001, "no normals");
        Assert.Equal(0, window.CloseWith("key Escape key Escape"));

        static bool IsEmpty(PixelImage image) => image.Pixels.AsSpan(4).SequenceEqual(image.Pixels.AsSpan(0, image.Pixels.Length - 4));
    }

    [SkippableFact]
    [Trait("Category", "Soak")]
    public void FractalPanel_ArgumentOfACall_TakesAnotherVector()
    {
        using var window = OpenLarge("row.fdo");
        var before = window.Screenshot();
        window.Send("key F4");
        TypeAt(window, "vectors of call 1", -10, 23, "3");
        Polling.WaitUntil(() => DrivenWindow.DifferingFraction(before, window.Screenshot()) > 0.003, "another position");
        Save(window, "row.fdo");
        Assert.Contains("z<x>. [#, t.3.2] x", File.ReadAllText(_folder["row.fdo"]), StringComparison.Ordinal);
        window.Send("key ctrl+z");
        window.WaitForTitle("row.fdo*");
        // There is no vector 9: the largest number counts, which is the one that was saved.
        var (x, y) = window.FindText("vectors of call 1");
        window.Send($"mousemove --window {{window}} {x - 10} {y + 23} click 1 key ctrl+a key 9 key Return");
        window.WaitForTitle("row.fdo -");
        Assert.Equal(0, window.CloseWith("key Escape"));
    }

    /// <summary>
    /// What a newcomer does who has read the README's first screen: open a tree, turn its numbers, save it, plant it twice in a scene.
    /// </summary>
    [SkippableFact]
    [Trait("Category", "Soak")]
    public void Newcomer_WithoutAnEditor_MakesAndSavesATree()
    {
        var tree = File.ReadAllText(Repository.Full("assets/fractals/tree.fdo")).Replace("../models/", "", StringComparison.Ordinal);
        _folder.Write("tree.fdo", tree);
        _folder.Write("branch.obj", File.ReadAllText(Repository.Full("assets/models/branch.obj")));
        using var window = OpenLarge();
        window.Send("key ctrl+o");
        window.Send("key ctrl+u");
        window.Type("tree.fdo");
        window.Send("key Return");
        window.WaitForTitle("tree.fdo");
        var before = window.Screenshot();
        window.Send("key F4");
        // The first side branch leans farther: the angles of vector 6, by keys.
        TypeAt(window, "rotation 6", 208, 23, "85");
        Polling.WaitUntil(() => DrivenWindow.DifferingFraction(before, window.Screenshot()) > 0.005, "another tree");
        window.WaitForTitle("tree.fdo*");
        Save(window, "tree.fdo");
        Assert.Contains("v 0 10 85\n", File.ReadAllText(_folder["tree.fdo"]), StringComparison.Ordinal);
        Assert.Equal(tree.Split('\n').Length, File.ReadAllText(_folder["tree.fdo"]).Split('\n').Length);
        // Planted twice in a scene of its own.
        window.Send("key ctrl+shift+s key ctrl+u");
        window.Type("garden.sdo");
        window.Send("key Return");
        window.WaitForTitle("garden.sdo");
        window.Send("key F4 key F2");
        // The only object stands below the head of the list.
        var (x, y) = window.FindText("Objects (1)");
        window.Send($"mousemove --window {{window}} {x} {y + 23} click 1");
        MoveAway(window);
        Click(window, "Duplicate");
        window.FindText("Objects (2)");
        Save(window, "garden.sdo");
        Assert.Equal(2, AssetLoader.Load(_folder["garden.sdo"]).Scene.Objects.Length);
        Assert.Equal(0, window.CloseWith("key Escape key Escape key d"));
    }

    // Pixels from the middle of an object to its handles.
    private const int Reach = 80;

    /// <summary>Returns the pixel of a point of the plane z = 0 in a frame of 640 × 480.</summary>
    private static (int X, int Y) At(double x, double y)
    {
        const double PixelsPerUnit = 240 / (0.57735 * 8);
        return ((int)Math.Round(320 + (PixelsPerUnit * x)), (int)Math.Round(240 - (PixelsPerUnit * y)));
    }

    private static void Select(DrivenWindow window, double x, double y)
    {
        var pixel = At(x, y);
        window.Send($"mousemove --window {{window}} {pixel.X} {pixel.Y} click 1");
    }

    /// <summary>Moves the pointer off the panels, where no tooltip covers them.</summary>
    private static void MoveAway(DrivenWindow window) => window.Send("mousemove --window {window} 450 600");

    private static void Click(DrivenWindow window, string text)
    {
        window.ClickText(text);
        MoveAway(window);
    }

    private static void Drag(DrivenWindow window, int x, int y, int toX, int toY, string? key = null)
    {
        // Handles stand where the frame before has shown them.
        window.ScreenshotWithPanels();
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

    private static void TypeAt(DrivenWindow window, string text, int right, int down, string number)
    {
        var (x, y) = window.FindText(text);
        window.Send($"mousemove --window {{window}} {x + right} {y + down} click 1");
        window.Send("key ctrl+a");
        window.Type(number);
        window.Send("key Return");
        MoveAway(window);
        // Once the changed file is loaded.
        window.FindText(number);
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

    private PixelImage Draw(params string[] options)
    {
        using var window = DrivenWindow.OpenInLowQuality(_folder, "scene.sdo", ["--resolution", "640x680", .. options]);
        window.WaitForError("missing.mtl");
        var image = window.Screenshot();
        Assert.Equal(0, window.CloseWith("key Escape"));
        return image;
    }

    private DrivenWindow OpenLarge(string file = "scene.sdo", string size = "900x700")
    {
        var window = DrivenWindow.OpenInLowQuality(_folder, file, "--resolution", size);
        window.WaitForError("missing.mtl");
        // Clicks before the first frame would meet nothing.
        window.Screenshot();
        return window;
    }

    private DrivenWindow Open(string file)
    {
        var window = DrivenWindow.OpenInLowQuality(_folder, file);
        window.WaitForError("missing.mtl");
        // Clicks before the first frame would meet nothing.
        window.Screenshot();
        return window;
    }
}
