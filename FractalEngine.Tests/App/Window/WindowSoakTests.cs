using System.Globalization;
using FractalEngine.Parsing.Sdo;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.App.Window;

/// <summary>Hard use of driven windows: kills while saving, random input, many sizes.</summary>
[Collection(DrivenWindow.Collection)]
public sealed class WindowSoakTests : IDisposable
{
    private const string Warning = "missing.mtl";

    private static readonly string[] Keys =
    [
        "w", "a", "s", "d", "e", "q", "f", "1", "3", "7", "5", "Return", "g", "x", "l", "t", "space", "n", "b", "r", "p", "c", "v", "i",
        "h", "Tab", "BackSpace", "Up", "Down", "Left", "Right", "ctrl+o", "ctrl+s", "ctrl+shift+s", "ctrl+z", "ctrl+shift+z", "k",
        "ctrl+u", "Home", "End", "Delete", "shift", "alt", "ctrl",
    ];

    private readonly TemporaryFolder _folder = new();

    public WindowSoakTests()
    {
        _folder.Write("cube.obj", "mtllib missing.mtl\nusemtl missing\n" + SampleFiles.Cube);
        var rest = string.Concat(Enumerable.Range(0, 200).Select(i => $"o \"cube.obj\" (({i}, 0, 0), #, #)\n"));
        _folder.Write("scene.sdo", "# kept\nc (2, 1.5, -3) (0.3, 0.6, 0) 60\n" + rest);
    }

    public void Dispose() => _folder.Dispose();

    [SkippableFact]
    [Trait("Category", "Soak")]
    public void Save_KilledTwoHundredTimes_LosesNothing() => KillWhileSaving(200);

    [SkippableFact]
    public void Window_OfRandomInput_GoesOn() => SendRandomInput(80);

    [SkippableFact]
    [Trait("Category", "Soak")]
    public void Window_OfTenThousandRandomEvents_GoesOn() => SendRandomInput(10_000);

    [SkippableFact]
    public void Window_OfManySizes_GoesOn() => Resize(8);

    [SkippableFact]
    [Trait("Category", "Soak")]
    public void Window_OfAThousandSizes_GoesOn() => Resize(1000);

    /// <summary>No driver has frames of so many pixels, but a window system may have such a window.</summary>
    [SkippableFact]
    [Trait("Category", "Soak")]
    public void Window_LargerThanTheDriverCanDraw_WaitsForAnotherSizeAndSaves()
    {
        using var window = Open();
        window.Send("key 3");
        var before = window.Screenshot();
        window.Send("windowsize {window} 32000 32000");
        window.WaitForError("32000");
        window.Send("key F12");
        window.WaitForError("no screenshot");
        window.Send("key ctrl+F12 key ctrl+s");
        window.WaitForError("saved scene.sdo");
        window.Send("windowsize --sync {window} 640 480");
        Polling.WaitUntil(() => DrivenWindow.DifferingFraction(before, window.Screenshot()) == 0, "frame as before");
        Assert.Equal(0, window.CloseWith("key Escape"));
    }

    private void KillWhileSaving(int count)
    {
        var random = new Random(5);
        var lines = File.ReadAllLines(_folder["scene.sdo"]);
        for (var i = 0; i < count; i++)
        {
            using var window = Open();
            window.Send("key 3 key ctrl+s key 1 key ctrl+s key 7 key ctrl+s", waits: false);
            Thread.Sleep(random.Next(60));
            window.Kill();
            var saved = File.ReadAllLines(_folder["scene.sdo"]);
            Assert.Equal(lines.Where((_, k) => k != 1), saved.Where((_, k) => k != 1));
            Assert.NotNull(SceneParser.Parse(new("scene.sdo", File.ReadAllText(_folder["scene.sdo"]))).Scene.Camera);
        }
    }

    private void SendRandomInput(int count)
    {
        var random = new Random(11);
        using var window = Open();
        for (var sent = 0; sent < count;)
        {
            var commands = Enumerable.Range(0, 50).Select(_ => random.Next(8) switch
            {
                0 => $"mousemove {random.Next(640)} {random.Next(480)}",
                1 => $"mousedown {random.Next(1, 4)}",
                2 => $"mouseup {random.Next(1, 4)}",
                3 => $"click {random.Next(4, 6)}",
                4 => $"keydown {Keys[random.Next(10)]}",
                5 => $"keyup {Keys[random.Next(10)]}",
                _ => $"key {Keys[random.Next(Keys.Length)]}",
            });
            window.Send(string.Join(' ', commands));
            sent += 50;
            Assert.False(window.HasExited, string.Create(CultureInfo.InvariantCulture, $"ended after {sent} events"));
        }

        window.Send("mouseup 1 mouseup 2 mouseup 3 " + string.Join(' ', Keys.Take(10).Select(key => $"keyup {key}")));
        // Closes a question that may be open, and lets go of what was changed.
        window.Send("key Escape");
        if (!window.HasExited)
        {
            window.Send("key Escape key d");
        }

        if (!window.HasExited)
        {
            window.Send("key Escape key d");
        }

        Assert.Equal(0, window.WaitForExit());
    }

    private void Resize(int count)
    {
        var random = new Random(3);
        using var window = Open();
        for (var i = 0; i < count; i++)
        {
            window.Send($"windowsize {{window}} {random.Next(1, 1200)} {random.Next(1, 900)}");
        }

        window.Send("windowsize --sync {window} 321 234");
        Polling.WaitUntil(() => window.Screenshot() is { Width: 321, Height: 234 }, "last size");
        Assert.Equal(0, window.CloseWith("key Escape"));
    }

    private DrivenWindow Open()
    {
        var window = DrivenWindow.Open(_folder, "scene.sdo");
        window.WaitForError(Warning);
        return window;
    }
}
