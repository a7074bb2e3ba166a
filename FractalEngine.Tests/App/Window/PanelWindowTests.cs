using FractalEngine.App.Window.Actions;
using FractalEngine.Core.Images;
using FractalEngine.Render.Windowing.Keyboard;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.App.Window;

/// <summary>Tests menus and panels of the window as a process, driven by xdotool.</summary>
[Collection(DrivenWindow.Collection)]
public sealed class PanelWindowTests : IDisposable
{
    private const string Warning = "missing.mtl";

    private const string Fractal =
        """
        # kept: three cubes
        v  1.5   0 0
        v 0.5 0.5 0.5
        t.a.b. (a, #, b)
        x. "cube.obj"
        z<x>. [#, t.1.2] x
        <$>. z   3
        # kept too

        """;

    private const string Scene =
        """
        # kept
        c (2, 1.5, -6) (0.2, 0.3, 0) 60
        o "cube.obj" ((0, 0, 0), #, #) name "left"
        # between
        o "cube.obj" ((3, 0, 0), #, #) name "right"

        """;

    private readonly TemporaryFolder _folder = new();

    public PanelWindowTests()
    {
        _folder.Write("cube.obj", "mtllib missing.mtl\nusemtl missing\n" + SampleFiles.Cube);
        _folder.Write("row.fdo", Fractal.Replace("\r", "", StringComparison.Ordinal));
        _folder.Write("scene.sdo", Scene.Replace("\r", "", StringComparison.Ordinal));
    }

    public void Dispose() => _folder.Dispose();

    [SkippableFact]
    public void FractalPanel_TypedNumber_IsShownUndoneAndSavedInItsPlace()
    {
        using var window = Open("row.fdo");
        var before = window.Screenshot();
        Polling.WaitUntil(
            () =>
            {
                // On a busy machine light within the fractal comes later than its first frame.
                var earlier = before;
                Thread.Sleep(TimeSpan.FromSeconds(0.5));
                before = window.Screenshot();
                return DrivenWindow.DifferingFraction(earlier, before) == 0;
            },
            "frame that stays");
        window.Send("key F4");
        window.ClickText("1.5");
        window.Send("key 2 key Return");
        Polling.WaitUntil(() => DrivenWindow.DifferingFraction(before, window.Screenshot()) > 0.003, "changed fractal");
        window.WaitForTitle("row.fdo*");
        window.Send("key ctrl+z");
        window.WaitForTitle("row.fdo -");
        Polling.WaitUntil(() => DrivenWindow.DifferingFraction(before, window.Screenshot()) == 0, "fractal as before");
        window.Send("key ctrl+shift+z");
        window.WaitForTitle("row.fdo*");
        window.Send("key ctrl+s");
        window.WaitForError("saved row.fdo");
        Assert.Equal(
            Fractal.Replace("1.5", "2", StringComparison.Ordinal), File.ReadAllText(_folder["row.fdo"]));
        window.WaitForTitle("row.fdo -");
        // The step before the save can still be undone.
        window.Send("key ctrl+z");
        window.WaitForTitle("row.fdo*");
        Polling.WaitUntil(() => DrivenWindow.DifferingFraction(before, window.Screenshot()) == 0, "fractal as before");
        Assert.Equal(0, window.CloseWith("key Escape key d"));
    }

    [SkippableFact]
    public void FractalPanel_NumberThatIsNoFractal_IsRefusedAndLaterOnesAreSavedInTheirPlace()
    {
        using var window = Open("row.fdo");
        window.Send("key F4");
        window.ClickText("depth of z", right: 120);
        window.Type("99999999999999");
        window.Send("key Return");
        window.ClickText("1.5");
        window.Type("1/0");
        window.Send("key Return");
        window.WaitForError("'1/0' is no number: division by zero");
        window.ClickText("1.5");
        window.Type("1/8");
        window.Send("key Return");
        window.WaitForTitle("row.fdo*");
        window.Send("key ctrl+s");
        window.WaitForError("saved row.fdo");
        Assert.Equal(Fractal.Replace("1.5", "0.125", StringComparison.Ordinal), File.ReadAllText(_folder["row.fdo"]));
        Assert.Equal(0, window.CloseWith("key Escape"));
    }

    [SkippableFact]
    public void FractalPanel_DepthByKeys_ChangesTheCounts()
    {
        using var window = Open("row.fdo");
        window.Send("key F4");
        window.FindText("instances");
        // The identity repeats some of the eight chains: four cubes are distinct.
        window.FindText("48");
        window.ClickText("depth of z", right: 120);
        window.Send("key Escape key Tab key shift+Tab");
        window.ClickText("depth of z", right: 120);
        window.Send("key 4 key Return");
        window.FindText("60");
        Assert.Equal(0, window.CloseWith("key Escape key d"));
    }

    [SkippableFact]
    public void ScenePanel_OfAnObject_RenamesMovesDuplicatesRemovesAndSaves()
    {
        using var window = Open("scene.sdo");
        var before = window.Screenshot();
        window.Send("key F2");
        window.ClickText("right");
        window.ClickText("Duplicate");
        window.FindText("Objects (3)");
        Polling.WaitUntil(() => DrivenWindow.DifferingFraction(before, window.Screenshot()) > 0.005, "third cube");
        window.Send("key ctrl+z");
        window.FindText("Objects (2)");
        window.ClickText("left");
        window.ClickText("Remove");
        window.FindText("Objects (1)");
        window.Send("key ctrl+s");
        window.WaitForError("saved scene.sdo");
        Assert.Equal(
            "# kept\nc (2, 1.5, -6) (0.2, 0.3, 0) 60\n# between\no \"cube.obj\" ((3, 0, 0), #, #) name \"right\"\n",
            File.ReadAllText(_folder["scene.sdo"]));
        Assert.Equal(0, window.CloseWith("key Escape"));
    }

    [SkippableFact]
    public void ScenePanel_ChosenObject_IsSelectedWithOutline()
    {
        using var window = Open("scene.sdo");
        var before = window.Screenshot();
        window.Send("key F2");
        window.ClickText("left");
        Polling.WaitUntil(() => CountOutlinePixels(window.ScreenshotWithPanels()) > 20, "outline of the chosen object");
        // The first Escape only takes the focus from the list.
        window.Send("key Escape key F6");
        window.FindText("the whole object");
        window.FindText("size");
        window.Send("key Escape");
        window.FindText("Click a surface");
        Assert.Equal(0, CountOutlinePixels(window.ScreenshotWithPanels()));
        Assert.Equal(0, DrivenWindow.DifferingFraction(before, window.Screenshot()));
        Assert.Equal(0, window.CloseWith("key Escape"));
    }

    [SkippableFact]
    public void Click_OnAnObject_SelectsItAndBackspaceAndEscapeGoUp()
    {
        using var window = Open("row.fdo");
        window.Send("key F6");
        window.FindText("Click a surface");
        window.Send("mousemove --window {window} 252 260 click 1");
        window.FindText("level 3");
        window.Send("key BackSpace");
        window.FindText("level 2");
        window.Send("key BackSpace key BackSpace");
        window.FindText("the whole object");
        window.Send("key Escape");
        window.FindText("Click a surface");
        Assert.Equal(0, window.CloseWith("key Escape"));
    }

    [SkippableFact]
    public void Settings_Panels_AreRememberedAndBrokenOnesReported()
    {
        using (var window = Open("scene.sdo"))
        {
            window.Send("key F3");
            window.FindText("field of view");
            Assert.Equal(0, window.CloseWith("key Escape"));
        }

        var path = Path.Combine(_folder.Path, "config", "FractalEngine", "window.txt");
        Assert.Contains("panel view open", File.ReadAllText(path), StringComparison.Ordinal);
        using (var window = Open("scene.sdo"))
        {
            window.FindText("field of view");
            Assert.Equal(0, window.CloseWith("key Escape"));
        }

        File.WriteAllText(path, "panel view wide open\n");
        using (var window = Open("scene.sdo"))
        {
            window.WaitForError("the settings are ignored");
            Assert.False(window.ShowsText("field of view"));
            Assert.Equal(0, window.CloseWith("key Escape"));
        }
    }

    /// <summary>Every action of the table by its key, then by its menu. Those that ask or close are answered with Esc.</summary>
    [SkippableFact]
    [Trait("Category", "Soak")]
    public void Actions_AllByKeysAndMenus_GoOn()
    {
        using var window = Open("row.fdo");
        string[] skipped = ["close", "new-fractal", "open", "approximate", "save", "save-as", "export"];
        var actions = ActionTable.All.Where(action => action.IsCommand && !skipped.Contains(action.Id)).ToArray();
        foreach (var chord in actions.SelectMany(static action => action.Keys))
        {
            window.Send($"key {XName(chord)}");
            if (chord == new KeyChord(Key.H))
            {
                window.FindText("open a file");
                window.Send("key Escape");
            }

            window.Screenshot();
            Assert.False(window.HasExited, $"ended after {chord}");
        }

        // Some of the keys were switches: from here on as at the beginning.
        Assert.Equal(0, CloseAll(window));
        File.Delete(Path.Combine(_folder.Path, "config", "FractalEngine", "window.txt"));
        using var other = Open("row.fdo");
        foreach (var action in actions.Where(static action => action.Id is not ("menu-bar" or "larger-text" or "smaller-text")))
        {
            other.ClickText(action.Menu);
            var place = other.FindText(action.Name);
            other.ClickText(action.Name);
            // A disabled item does nothing and stays: Esc closes its menu, and the list of keys. Elsewhere it would close the window.
            if (action.Id == "keys" || other.TryFindText(action.Name) == place)
            {
                other.Send("key Escape");
            }

            Assert.False(other.HasExited, $"ended after {action.Name}");
            if (action.Id == "light-colours")
            {
                other.Send("key ctrl+l");
            }
        }

        Assert.Equal(0, CloseAll(other));
    }

    [SkippableFact]
    [Trait("Category", "Soak")]
    public void Window_WithAllPanels_SleepsAndFits()
    {
        using var window = DrivenWindow.Open(_folder, "scene.sdo", "--resolution", "1280x720");
        window.WaitForError(Warning);
        window.Send("key F2 key F3 key F4 key F5 key F6 key i");
        foreach (var text in (string[])["Scene", "Fractal", "Selection", "field of view", "Physics", "Statistics"])
        {
            window.FindText(text);
        }

        // The message of the screenshot is shown for four seconds.
        Thread.Sleep(TimeSpan.FromSeconds(4.5));
        var before = window.ProcessorTime;
        Thread.Sleep(TimeSpan.FromSeconds(5));
        var used = window.ProcessorTime - before;
        Assert.True(used < TimeSpan.FromSeconds(0.1), $"an idle window with panels took {used.TotalSeconds:F3} s in 5 s");
        Assert.Equal(0, window.CloseWith("key Escape"));
    }

    /// <summary>Closes questions, ends measuring and selecting, and lets go of what was changed.</summary>
    private static int CloseAll(DrivenWindow window)
    {
        for (var i = 0; i < 6 && !window.HasExited; i++)
        {
            window.Send("key Escape");
            if (!window.HasExited)
            {
                window.Send("key d");
            }
        }

        return window.WaitForExit();
    }

    private static string XName(KeyChord chord)
    {
        var key = chord.Key switch
        {
            Key.Plus => "plus",
            Key.Minus => "minus",
            Key.Enter => "Return",
            Key.Backspace => "BackSpace",
            >= Key.F1 and <= Key.F12 => chord.Key.ToString(),
            >= Key.Digit0 and <= Key.Digit9 => chord.ToString(),
            _ => chord.Key.ToString().ToLowerInvariant(),
        };
        return (chord.Modifiers.HasFlag(KeyModifiers.Control) ? "ctrl+" : "")
            + (chord.Modifiers.HasFlag(KeyModifiers.Shift) ? "shift+" : "") + key;
    }

    private static int CountOutlinePixels(PixelImage image)
    {
        var count = 0;
        for (var y = 0; y < image.Height; y++)
        {
            for (var x = 0; x < image.Width; x++)
            {
                var (red, green, blue, _) = image[x, y];
                count += Math.Abs(red - 255) + Math.Abs(green - 184) + Math.Abs(blue - 51) < 60 ? 1 : 0;
            }
        }

        return count;
    }

    private DrivenWindow Open(string file)
    {
        var window = DrivenWindow.OpenInLowQuality(_folder, file);
        window.WaitForError(Warning);
        return window;
    }
}
