using System.Diagnostics;
using System.Globalization;
using System.Text.RegularExpressions;
using FractalEngine.Core.Images;
using FractalEngine.Render.Images;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.App.Window;

/// <summary>A process of the program whose window xdotool drives.</summary>
internal sealed partial class DrivenWindow : IDisposable
{
    /// <summary>The collection of all tests that drive windows: one window at a time has the keyboard.</summary>
    public const string Collection = "driven windows";

    private readonly IDisposable _focus;
    private readonly Process _process;
    private readonly List<string> _errorLines = [];
    private readonly string _folder;
    private readonly string _window;

    private DrivenWindow(string folder, string file, string[] options, bool isTraced, string? resources)
    {
        _folder = folder;
        // The list of recent files is that of the test.
        var environment = new Dictionary<string, string?>
        {
            ["FRACTALENGINE_NO_WINDOW"] = null,
            ["XDG_CONFIG_HOME"] = Path.Combine(folder, "config"),
            ["XENVIRONMENT"] = resources,
        };
        // What converges would change the pixels that a test looks at.
        string[] trace = isTraced || options.Contains("--trace") ? [] : ["--no-trace"];
        string[] size = options.Contains("--resolution") ? [] : ["--resolution", "640x480"];
        _focus = Display.TakeFocus(Collection);
        _process = AppProcess.Start(folder, environment, ["view", file, .. size, .. trace, .. options]);
        _process.ErrorDataReceived += (_, line) =>
        {
            lock (_errorLines)
            {
                _errorLines.Add(line.Data ?? "");
            }
        };
        _process.BeginErrorReadLine();
        try
        {
            _window = WaitFor(
                // The window has to be of this process: that of an earlier one may still be there.
                () => RunXdotool($"search --all --pid {_process.Id} --name {Path.GetFileName(file)}.*FractalEngine")
                    .Split('\n', StringSplitOptions.RemoveEmptyEntries).LastOrDefault(),
                "window");
            Send("windowfocus --sync {window}");
        }
        catch
        {
            Dispose();
            throw;
        }
    }

    /// <summary>Opens a window on a file. Skips the test where no window can be driven.</summary>
    /// <remarks>It is not traced while it stands still, unless an option says so.</remarks>
    public static DrivenWindow Open(TemporaryFolder folder, string file, params string[] options) =>
        Open(folder, file, options, isTraced: false);

    /// <summary>
    /// As <see cref="Open(TemporaryFolder, string, string[])"/>, for tests of what is shown rather than how well: a frame and its
    /// screenshot take a third of the time, and nothing is drawn again while the window rests.
    /// </summary>
    public static DrivenWindow OpenInLowQuality(TemporaryFolder folder, string file, params string[] options) => Open(
        folder, file, ["--samples", "0", "--gather", "1", "--no-shadows", "--no-ambient-occlusion", .. options]);

    /// <summary>Opens a window as a user does, without any option. Skips the test where no window can be driven.</summary>
    public static DrivenWindow OpenPlainly(TemporaryFolder folder, string file) => Open(folder, file, [], isTraced: true);

    /// <summary>Opens a window on a desktop whose X resources are those of a file.</summary>
    public static DrivenWindow OpenWithResources(TemporaryFolder folder, string file, string resources) =>
        Open(folder, file, [], isTraced: false, folder[resources]);

    private static DrivenWindow Open(TemporaryFolder folder, string file, string[] options, bool isTraced, string? resources = null)
    {
        Display.Require();
        Skip.IfNot(IsAvailable, "xdotool is not installed");
        return new(folder.Path, file, options, isTraced, resources);
    }

    private static bool IsAvailable => (Environment.GetEnvironmentVariable("PATH") ?? "").Split(Path.PathSeparator)
        .Any(folder => File.Exists(Path.Combine(folder, "xdotool")));

    public TimeSpan ProcessorTime
    {
        get
        {
            _process.Refresh();
            return _process.TotalProcessorTime;
        }
    }

    /// <summary>Sends input by xdotool, in whose commands {window} is the window.</summary>
    /// <param name="commands">Commands of xdotool.</param>
    /// <param name="waits">False to return while the input is still being sent.</param>
    public void Send(string commands, bool waits = true) =>
        RunXdotool(commands.Replace("{window}", _window, StringComparison.Ordinal), waits);

    /// <summary>Waits until the program has written a line with this text to stderr.</summary>
    public void WaitForError(string text) =>
        WaitFor(() => ErrorLines().FirstOrDefault(line => line.Contains(text, StringComparison.Ordinal)), $"line with '{text}'");

    /// <summary>Waits until the title of the window has a text.</summary>
    public void WaitForTitle(string text) => WaitFor(
        () => RunXdotool($"getwindowname {_window}") is var title && title.Contains(text, StringComparison.Ordinal) ? title : null,
        $"title with '{text}'");

    /// <summary>Stops the program meanwhile, so that it learns of all input at once.</summary>
    public void WhileStopped(Action send)
    {
        Signals.Send(_process, "STOP");
        send();
        Signals.Send(_process, "CONT");
    }

    /// <summary>Width and height of the window, as the window system knows them.</summary>
    public (int Width, int Height) Size
    {
        get
        {
            var lines = RunXdotool($"getwindowgeometry --shell {_window}").Split('\n');
            int Number(string name) => int.Parse(lines.First(line => line.StartsWith(name, StringComparison.Ordinal))[name.Length..],
                CultureInfo.InvariantCulture);
            return (Number("WIDTH="), Number("HEIGHT="));
        }
    }

    /// <summary>Takes a screenshot. All earlier input has been handled before.</summary>
    public PixelImage Screenshot() => Screenshot("key F12");

    /// <summary>Takes a screenshot with menus and panels. All earlier input has been handled before.</summary>
    public PixelImage ScreenshotWithPanels() => Screenshot("key ctrl+F12");

    /// <summary>Clicks the middle of a text that menus and panels show.</summary>
    /// <param name="text">The text, of which the last place counts.</param>
    /// <param name="right">Pixels to the right of the middle.</param>
    public void ClickText(string text, int right = 0)
    {
        var (x, y) = FindText(text);
        Send(string.Create(CultureInfo.InvariantCulture, $"mousemove --window {{window}} {x + right} {y} click 1"));
    }

    /// <summary>Waits until menus and panels show a text, and returns its middle.</summary>
    public (int X, int Y) FindText(string text)
    {
        var found = WaitFor(() => ScreenText.Find(ScreenshotWithPanels(), text) is { } place ? (object)place : null, $"text '{text}'");
        return ((int, int))found;
    }

    /// <summary>Returns the middle of a text that menus and panels show now; null where they don't.</summary>
    public (int X, int Y)? TryFindText(string text) => ScreenText.Find(ScreenshotWithPanels(), text);

    /// <summary>Tells whether menus and panels show a text now.</summary>
    public bool ShowsText(string text) => TryFindText(text) is not null;

    private PixelImage Screenshot(string command)
    {
        var count = SavedImages().Length;
        Send(command);
        return ImageFile.Load(Path.Combine(_folder, WaitFor(() => SavedImages().ElementAtOrDefault(count), "screenshot")));
    }

    public int CloseWith(string commands)
    {
        Send(commands);
        return WaitForExit();
    }

    /// <summary>Waits until the program has ended, and returns its exit code.</summary>
    public int WaitForExit()
    {
        Assert.True(_process.WaitForExit(Polling.Deadline), "the window did not close");
        return _process.ExitCode;
    }

    /// <summary>True once the program has ended.</summary>
    public bool HasExited => _process.HasExited;

    /// <summary>Ends the program at once, as a crash would.</summary>
    public void Kill()
    {
        _process.Kill(entireProcessTree: true);
        _process.WaitForExit();
    }

    /// <summary>Types text into the window.</summary>
    public void Type(string text) => RunXdotool($"type --delay 5 -- \"{text}\"");

    /// <summary>Number of lines with a text that the program has written to stderr.</summary>
    public int CountErrors(string text) => ErrorLines().Count(line => line.Contains(text, StringComparison.Ordinal));

    /// <summary>Computes the fraction of pixels that differ visibly; it is 1 for images of different sizes.</summary>
    public static double DifferingFraction(PixelImage image1, PixelImage image2)
    {
        if ((image1.Width, image1.Height) != (image2.Width, image2.Height))
        {
            return 1;
        }

        var differing = 0;
        for (var i = 0; i < image1.Pixels.Length; i += 4)
        {
            differing += Differs(i) || Differs(i + 1) || Differs(i + 2) ? 1 : 0;
        }

        return differing / (image1.Pixels.Length / 4.0);

        bool Differs(int k) => Math.Abs(image1.Pixels[k] - image2.Pixels[k]) > 8;
    }

    public void Dispose()
    {
        if (!_process.HasExited)
        {
            _process.Kill(entireProcessTree: true);
        }

        _process.Dispose();
        _focus.Dispose();
    }

    private T WaitFor<T>(Func<T?> get, string description)
        where T : class => Polling.WaitFor(
            () => get() ?? (_process.HasExited
                ? throw new InvalidOperationException($"the program ended with {_process.ExitCode}: {string.Join('\n', ErrorLines())}")
                : null),
            description);

    private string[] ErrorLines()
    {
        lock (_errorLines)
        {
            return [.. _errorLines];
        }
    }

    private string[] SavedImages() =>
        [.. ErrorLines().Select(line => SavedImage().Match(line)).Where(match => match.Success).Select(match => match.Groups[1].Value)];

    /// <summary>Runs xdotool, and returns what it prints.</summary>
    public static string RunXdotool(string commands, bool waits = true)
    {
        var start = new ProcessStartInfo("xdotool", commands) { RedirectStandardOutput = true, RedirectStandardError = true };
        using var tool = Process.Start(start)!;
        if (!waits)
        {
            return "";
        }

        var output = tool.StandardOutput.ReadToEnd();
        tool.WaitForExit();
        return output;
    }

    [GeneratedRegex(@"^saved (out\S+\.png)$")]
    private static partial Regex SavedImage();
}
