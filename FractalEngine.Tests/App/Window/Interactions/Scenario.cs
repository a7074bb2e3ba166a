using System.Globalization;
using FractalEngine.Core.Images;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.App.Window.Interactions;

/// <summary>A window of 900 × 700 pixels with the files of an interaction, and the steps and expectations that rows are made of.</summary>
internal sealed partial class Scenario : IDisposable
{
    private const int Width = 900;
    private const int Height = 700;

    // The height of a row of a panel at scale 1.
    private const int PanelWidth = 297;

    private readonly TemporaryFolder _folder = new();
    private PixelImage _before;

    /// <summary>Writes the files, and opens the window.</summary>
    public Scenario(Interaction interaction)
    {
        foreach (var (name, text) in InteractionFiles.All)
        {
            _folder.Write(name, text.Replace("\r", "", StringComparison.Ordinal));
        }

        if (interaction.NeedsLargeFile)
        {
            InteractionFiles.WriteLarge(_folder["large.obj"]);
        }

        if (interaction.Settings.Length > 0)
        {
            Directory.CreateDirectory(Path.GetDirectoryName(SettingsPath)!);
            File.WriteAllText(SettingsPath, interaction.Settings);
        }

        try
        {
            Window = DrivenWindow.Open(_folder, interaction.File, ["--resolution", "900x700", .. interaction.Options]);
            Window.WaitForError("missing.mtl");
            _before = Window.Screenshot();
        }
        catch
        {
            Dispose();
            throw;
        }
    }

    /// <summary>The window with the file.</summary>
    public DrivenWindow Window { get; } = null!;

    private string SettingsPath => Path.Combine(_folder.Path, "config", "FractalEngine", "window.txt");

    /// <summary>Ends the program, whatever it asks.</summary>
    public void Close()
    {
        for (var i = 0; i < 8 && !Window.HasExited; i++)
        {
            Window.Send("key Escape");
            if (!Window.HasExited)
            {
                Window.Send("key d");
            }
        }

        Assert.Equal(0, Window.WaitForExit());
    }

    public void Dispose()
    {
        Window?.Dispose();
        _folder.Dispose();
    }

    /// <summary>Presses keys, which are named as xdotool names them, with blanks between.</summary>
    public static Action<Scenario> Keys(string keys) => s => s.Window.Send(
        string.Join(' ', keys.Split(' ').Select(static key => $"key {key}")));

    /// <summary>Types a text into the field that has the focus.</summary>
    public static Action<Scenario> Text(string text) => s => s.Window.Type(text);

    /// <summary>Clicks beside a text that menus and panels show.</summary>
    public static Action<Scenario> Click(string text, int right = 0, int down = 0) => s =>
    {
        var (x, y) = s.Window.FindText(text);
        s.ClickPixel(x + right, y + down, 1);
    };

    /// <summary>Clicks a pixel with a button, once or more.</summary>
    public static Action<Scenario> ClickAt(int x, int y, int count = 1, int button = 1) => s => s.ClickPixel(x, y, count, button);

    /// <summary>Clicks a pixel while Ctrl is held.</summary>
    public static Action<Scenario> ControlClickAt(int x, int y) => s =>
    {
        s.Window.Send("keydown Control_L");
        s.ClickPixel(x, y, 1);
        s.Window.Send("keyup Control_L");
    };

    /// <summary>
    /// Clicks a text twice, so that the program learns of the second click before it can show what the first one leads to.
    /// </summary>
    public static Action<Scenario> ClickTwiceAtOnce(string text) => s =>
    {
        var (x, y) = s.Window.FindText(text);
        s.Window.WhileStopped(() => s.ClickPixel(x, y, 2));
    };

    /// <summary>Clicks one of the columns of a row of a panel, so many rows below a text.</summary>
    public static Action<Scenario> ClickColumn(string text, int column, int columns = 3, int rows = 1, bool isRight = false) => s =>
    {
        var (x, y) = s.Place(text, column, columns, rows, isRight);
        s.ClickPixel(x, y, 1);
    };

    /// <summary>Types a number or a text where a click on a column begins to type it.</summary>
    public static Action<Scenario> Type(
        string value, string text, int column = 0, int columns = 1, int rows = 0, bool isRight = false) => s =>
    {
        var (x, y) = s.Place(text, column, columns, rows, isRight);
        s.Window.Send(string.Create(CultureInfo.InvariantCulture, $"mousemove --window {{window}} {x} {y} click 1 key ctrl+a"));
        s.Window.Type(value);
        s.Window.Send("key Return");
        s.MoveAway();
    };

    /// <summary>
    /// Opens the large file that a question has the name of, and types the first number below a text while it loads.
    /// </summary>
    public static Action<Scenario> OpenAndType(string value, string text) => s =>
    {
        var (x, y) = s.Place(text, 0, 3, 1, isRight: false);
        var digits = string.Join(' ', value.Select(static digit => digit == '.' ? "key period" : $"key {digit}"));
        s.Window.Send(string.Create(
            CultureInfo.InvariantCulture, $"mousemove --window {{window}} {x} {y} key Return click 1 key ctrl+a {digits} key Return"));
    };

    /// <summary>Drags a slider, by a number of pixels.</summary>
    public static Action<Scenario> Slide(
        int pixels, string text, int column = 0, int columns = 1, int rows = 0, bool isRight = false) => s =>
    {
        var (x, y) = s.Place(text, column, columns, rows, isRight);
        s.DragPixels(x, y, x + pixels, y, 1);
        s.MoveAway();
    };

    /// <summary>Drags from one pixel to another.</summary>
    public static Action<Scenario> Drag(int x, int y, int toX, int toY, int button = 1, string? key = null) => s =>
    {
        // Handles stand where the frame before has shown them.
        s.Window.ScreenshotWithPanels();
        s.DragPixels(x, y, toX, toY, button, key);
    };

    /// <summary>Drags a text that panels show.</summary>
    public static Action<Scenario> DragText(string text, int right, int down) => s =>
    {
        var (x, y) = s.Window.FindText(text);
        s.DragPixels(x, y, x + right, y + down, 1);
    };

    /// <summary>Turns the wheel over a pixel: towards the scene for positive notches.</summary>
    public static Action<Scenario> Wheel(int x, int y, int notches) => s => s.Window.Send(string.Create(
        CultureInfo.InvariantCulture,
        $"mousemove --window {{window}} {x} {y} click --repeat {Math.Abs(notches)} --delay 5 {(notches > 0 ? 4 : 5)}"));

    /// <summary>Moves the pointer onto a text.</summary>
    public static Action<Scenario> PointAt(string text) => s =>
    {
        var (x, y) = s.Window.FindText(text);
        s.Window.Send(string.Create(CultureInfo.InvariantCulture, $"mousemove --window {{window}} {x} {y}"));
    };

    /// <summary>Takes the present frame as the one to compare with.</summary>
    public static Action<Scenario> Remember { get; } = s => s._before = s.Window.Screenshot();

    /// <summary>Saves with Ctrl+S, and waits for that.</summary>
    public static Action<Scenario> Save(string file = "scene.sdo") => s =>
    {
        var count = s.Window.CountErrors($"saved {file}");
        s.Window.WaitForTitle("*");
        Polling.WaitUntil(
            () =>
            {
                // An edit is shown before it can be saved.
                s.Window.Send("key ctrl+s");
                s.Window.Screenshot();
                return s.Window.CountErrors($"saved {file}") > count;
            },
            $"saved {file}");
    };

    /// <summary>The frame looks different from the one before, in at least this part of its pixels.</summary>
    public static Action<Scenario> FrameDiffers(double fraction) => s => Polling.WaitUntil(
        () => DrivenWindow.DifferingFraction(s._before, s.Window.Screenshot()) >= fraction, $"frame that differs by {fraction}");

    /// <summary>The frame looks as before.</summary>
    public static Action<Scenario> FrameIsAsBefore { get; } = s => Polling.WaitUntil(
        () => DrivenWindow.DifferingFraction(s._before, s.Window.Screenshot()) == 0, "frame as before");

    /// <summary>Menus and panels show a text.</summary>
    public static Action<Scenario> Shows(string text) => s => s.Window.FindText(text);

    /// <summary>Menus and panels don't show a text.</summary>
    public static Action<Scenario> Hides(string text) => s => Polling.WaitUntil(() => !s.Window.ShowsText(text), $"no text '{text}'");

    /// <summary>The file on the disk has a text.</summary>
    public static Action<Scenario> FileHas(string text, string file = "scene.sdo") => s =>
        Assert.Contains(text, File.ReadAllText(s._folder[file]), StringComparison.Ordinal);

    /// <summary>The file on the disk has no such text.</summary>
    public static Action<Scenario> FileLacks(string text, string file = "scene.sdo") => s =>
        Assert.DoesNotContain(text, File.ReadAllText(s._folder[file]), StringComparison.Ordinal);

    /// <summary>There is no such file on the disk.</summary>
    public static Action<Scenario> FileIsMissing(string file) => s => Assert.False(File.Exists(s._folder[file]));

    /// <summary>The file on the disk is this text.</summary>
    public static Action<Scenario> FileIs(string text, string file = "scene.sdo") => s =>
        Assert.Equal(text.Replace("\r", "", StringComparison.Ordinal), File.ReadAllText(s._folder[file]));

    /// <summary>The settings on the disk come to have a line.</summary>
    public static Action<Scenario> SettingsHave(string line) => s => Polling.WaitUntil(
        () => File.Exists(s.SettingsPath) && File.ReadLines(s.SettingsPath).Any(read => read.StartsWith(line, StringComparison.Ordinal)),
        $"setting '{line}'");

    /// <summary>The title has a text.</summary>
    public static Action<Scenario> Title(string text) => s => s.Window.WaitForTitle(text);

    /// <summary>The program writes a line with a text to stderr.</summary>
    public static Action<Scenario> Reports(string text) => s => s.Window.WaitForError(text);

    /// <summary>The clipboard has a text, which is pasted into a question and read there.</summary>
    public static Action<Scenario> ClipboardHas(string text) => s =>
    {
        s.Window.Send("key ctrl+o key ctrl+u key ctrl+v");
        s.Window.FindText(text);
        s.Window.Send("key Escape");
    };

    /// <summary>The frame comes to be larger than the window was at first, as far as the program knows.</summary>
    public static Action<Scenario> IsLarger { get; } = static s =>
        Polling.WaitUntil(() => s.Window.Screenshot() is { Width: > Width, Height: > Height }, "larger frame");

    /// <summary>A pixel of the frame comes to be the background, or something else.</summary>
    public static Action<Scenario> PixelIsBackground(int x, int y, bool isBackground) => s => Polling.WaitUntil(
        () =>
        {
            var image = s.Window.Screenshot();
            return image[x, y].Equals(image[Width - 2, image.Height - 2]) == isBackground;
        },
        "pixel");

    /// <summary>The window closes.</summary>
    public static Action<Scenario> Exits { get; } = static s => Assert.Equal(0, s.Window.WaitForExit());

    private (int X, int Y) Place(string text, int column, int columns, int rows, bool isRight)
    {
        var y = Window.FindText(text).Y + (23 * rows);
        return ((isRight ? Width - PanelWidth : 0) + (int)((column + 0.5) * PanelWidth / columns), y);
    }

    private void ClickPixel(int x, int y, int count, int button = 1)
    {
        Window.Send(string.Create(
            CultureInfo.InvariantCulture, $"mousemove --window {{window}} {x} {y} click --repeat {count} --delay 30 {button}"));
        MoveAway();
    }

    private void DragPixels(int x, int y, int toX, int toY, int button, string? key = null)
    {
        Window.Send(string.Create(CultureInfo.InvariantCulture, $"mousemove --window {{window}} {x} {y} mousedown {button}"));
        if (key is not null)
        {
            Window.Send($"keydown {key}");
        }

        // In steps, as a hand does.
        for (var i = 1; i <= 4; i++)
        {
            Window.Send(string.Create(
                CultureInfo.InvariantCulture, $"mousemove --window {{window}} {x + ((toX - x) * i / 4)} {y + ((toY - y) * i / 4)}"));
        }

        Window.Send(key is null ? $"mouseup {button}" : $"mouseup {button} keyup {key}");
    }

    /// <summary>Moves the pointer off the panels, where no tooltip covers them.</summary>
    private void MoveAway() => Window.Send("mousemove --window {window} 450 600");
}
