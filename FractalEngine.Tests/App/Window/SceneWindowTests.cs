using System.Diagnostics;
using System.Globalization;
using FractalEngine.Core.Images;
using FractalEngine.Parsing.Scenes;
using FractalEngine.Render.Images;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.App.Window;

/// <summary>
/// Tests the window as users see it: a process on the display of the tests, driven with keys, mouse and resizes by xdotool.
/// </summary>
[Collection("GL")]
public sealed class SceneWindowTests : IDisposable
{
    private const string Scene = "# kept\nc (2, 1.5, -3) (0.3, 0.6, 0) 60\n# kept too\no \"cube.obj\" #\n";

    private static readonly TimeSpan Timeout = TimeSpan.FromSeconds(20);

    private readonly TemporaryFolder _folder = new();

    public SceneWindowTests()
    {
        _folder.Write("cube.obj", SampleFiles.Cube);
        _folder.Write("scene.sdo", Scene);
    }

    public void Dispose() => _folder.Dispose();

    [SkippableFact]
    public void Window_DrivenByKeysAndMouse_MovesSavesAndCloses()
    {
        using var window = Open("scene.sdo");
        var start = window.Screenshot(1);
        Assert.Equal((640, 480), (start.Width, start.Height));

        window.Send("key 3");
        var fromTheRight = window.Screenshot(2);
        Assert.True(DifferingFraction(start, fromTheRight) > 0.01, "the key 3 changed nothing");

        window.Send("mousemove --window {window} 300 240 mousedown 1 mousemove_relative 60 25 mousemove_relative 60 25 mouseup 1");
        var orbited = window.Screenshot(3);
        Assert.True(DifferingFraction(fromTheRight, orbited) > 0.01, "the drag changed nothing");

        window.Send("click 5 click 5 click 5");
        var zoomed = window.Screenshot(4);
        Assert.True(DifferingFraction(orbited, zoomed) > 0.01, "the wheel changed nothing");

        window.Send("key w key w");
        Assert.True(DifferingFraction(zoomed, window.Screenshot(5)) > 0.01, "the key W changed nothing");

        window.Send("windowsize {window} 400 300 sleep 0.5");
        var resized = window.Screenshot(6);
        Assert.Equal((400, 300), (resized.Width, resized.Height));

        window.Send("key Return key 5");
        Assert.True(DifferingFraction(resized, window.Screenshot(7)) > 0.01, "Enter and 5 changed nothing");

        window.Send("key ctrl+s");
        var text = WaitFor(() => File.ReadAllText(_folder["scene.sdo"]) is var now && now != Scene ? now : null);
        var lines = text.Split('\n');
        Assert.Equal(("# kept", "# kept too", "o \"cube.obj\" #", "projection orthographic"), (lines[0], lines[2], lines[3], lines[4]));
        // Enter has returned to the camera of the file, so its line is unchanged.
        Assert.Equal(Scene.Split('\n')[1], lines[1]);
        Assert.NotNull(SceneParser.Parse(new("scene.sdo", text)).Scene.Camera);

        Assert.Equal(0, window.CloseWith("key Escape"));
    }

    [SkippableFact]
    public void Window_KeyL_ShowsTheHighlightOfALargeFace()
    {
        _folder.Write("shiny.mtl", "newmtl shiny\nKd 0 0 0\nKs 1 1 1\nNs 30\n");
        _folder.Write("shiny.obj", "mtllib shiny.mtl\nv -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nusemtl shiny\nf 1 4 3 2\n");
        _folder.Write("shiny.sdo", "c (0, 0, -3) (0, 0, 0) 50\nlight point (0, 0, -1) (1, 1, 1) 1 10\no \"shiny.obj\" #\n");
        using var window = Open("shiny.sdo");
        var atVertices = window.Screenshot(1);
        window.Send("key l");
        Assert.True(DifferingFraction(atVertices, window.Screenshot(2)) > 0.01, "the key L changed nothing");
        Assert.Equal(0, window.CloseWith("key Escape"));
    }

    [SkippableFact]
    public void Window_OfBodies_PausesStepsResetsDropsAndWalks()
    {
        _folder.Write("fall.sdo",
            """
            c (0, 1, -6) (0, 0, 0) 60
            o "cube.obj" ((0, -1, 0), #, (8, 1, 8))
            p "cube.obj" ((0, 40, 0), #, #) 0 colour (1, 0, 0)
            player (2, 1, -2) 0.3 1.6

            """);
        using var window = Open("fall.sdo");
        // The simulation runs from the beginning, until Space pauses it.
        window.Send("key space");
        var stopped = window.Screenshot(1);
        Thread.Sleep(TimeSpan.FromSeconds(0.5));
        Assert.Equal(0, DifferingFraction(stopped, window.Screenshot(2)));

        // After 4 s the body lies in front of the camera.
        window.Send(string.Join(' ', Enumerable.Repeat("key n", 240)));
        var fallen = window.Screenshot(3);
        Assert.True(DifferingFraction(stopped, fallen) > 0.01, "240 steps changed nothing");

        window.Send("key r");
        Assert.Equal(0, DifferingFraction(stopped, window.Screenshot(4)));

        window.Send("key b");
        Assert.True(DifferingFraction(stopped, window.Screenshot(5)) > 0.001, "the key B changed nothing");

        window.Send("key r key p");
        var walking = window.Screenshot(6);
        Assert.True(DifferingFraction(stopped, walking) > 0.01, "the key P changed nothing");

        window.Send("key p");
        Assert.Equal(0, window.CloseWith("key Escape"));
    }

    [SkippableFact]
    public void Window_WithoutChanges_Sleeps()
    {
        using var window = Open("scene.sdo");
        window.Screenshot(1);
        // The message of the screenshot is shown for four seconds, then one more frame is presented.
        Thread.Sleep(TimeSpan.FromSeconds(5));
        var before = window.ProcessorTime;
        Thread.Sleep(TimeSpan.FromSeconds(2));
        var coreFraction = (window.ProcessorTime - before).TotalSeconds / 2;
        // A loop that draws or polls takes a whole core, and waiting for events almost nothing. The limit allows for a noisy machine.
        Assert.True(coreFraction < 0.15, $"an idle window took {coreFraction:P0} of a core");
        Assert.Equal(0, window.CloseWith("key Escape"));
    }

    [SkippableFact]
    public void Window_OnABadFile_ShowsTheErrorAndExitsWith1()
    {
        _folder.Write("bad.sdo", "o \"cube.obj\" (\n");
        using var window = Open("bad.sdo");
        Thread.Sleep(TimeSpan.FromSeconds(1));
        Assert.Equal(1, window.CloseWith("key Escape"));
        // The system's own libraries may write lines of theirs.
        Assert.Matches(@"(?m)^bad\.sdo:1:", window.Error);
    }

    private DrivenWindow Open(string file)
    {
        Skip.If(string.IsNullOrEmpty(Environment.GetEnvironmentVariable("DISPLAY")), "there is no display");
        Skip.IfNot(DrivenWindow.IsAvailable, "xdotool is not installed");
        return new(_folder.Path, file);
    }

    /// <summary>Computes the fraction of pixels that differ visibly; it is 1 for images of different sizes.</summary>
    private static double DifferingFraction(PixelImage image1, PixelImage image2)
    {
        if ((image1.Width, image1.Height) != (image2.Width, image2.Height))
        {
            return 1;
        }

        var differing = 0;
        for (var i = 0; i < image1.Pixels.Length; i += 4)
        {
            differing += Enumerable.Range(i, 3).Any(k => Math.Abs(image1.Pixels[k] - image2.Pixels[k]) > 8) ? 1 : 0;
        }

        return differing / (image1.Pixels.Length / 4.0);
    }

    private static T WaitFor<T>(Func<T?> get)
        where T : class
    {
        for (var clock = Stopwatch.StartNew(); clock.Elapsed < Timeout; Thread.Sleep(50))
        {
            if (get() is { } value)
            {
                return value;
            }
        }

        throw new TimeoutException($"no result within {Timeout}");
    }

    /// <summary>A process of the program whose window xdotool drives.</summary>
    private sealed class DrivenWindow : IDisposable
    {
        private readonly Process _process;
        private readonly Task<string> _error;
        private readonly string _folder;
        private readonly string _name;
        private readonly string _window;

        public DrivenWindow(string folder, string file)
        {
            _folder = folder;
            _name = Path.GetFileNameWithoutExtension(file);
            _process = AppProcess.Start(folder, new() { ["FRACTALENGINE_NO_WINDOW"] = null }, "view", file, "--resolution", "640x480");
            _error = _process.StandardError.ReadToEndAsync();
            _window = WaitFor(() => _process.HasExited
                ? throw new InvalidOperationException($"the program ended with {_process.ExitCode}: {Error}")
                : RunXdotool($"search --name {file}.*FractalEngine").Split('\n', StringSplitOptions.RemoveEmptyEntries).LastOrDefault());
            Send("windowfocus --sync {window}");
        }

        public static bool IsAvailable => (Environment.GetEnvironmentVariable("PATH") ?? "").Split(Path.PathSeparator)
            .Any(folder => File.Exists(Path.Combine(folder, "xdotool")));

        public string Error => _error.GetAwaiter().GetResult();

        public TimeSpan ProcessorTime
        {
            get
            {
                _process.Refresh();
                return _process.TotalProcessorTime;
            }
        }

        public void Send(string commands) => RunXdotool(commands.Replace("{window}", _window, StringComparison.Ordinal));

        /// <summary>Takes a screenshot under the program's next number. Once it exists, all earlier input has been handled.</summary>
        public PixelImage Screenshot(int number)
        {
            var path = Path.Combine(_folder, "out", string.Create(CultureInfo.InvariantCulture, $"{_name}-{number:D3}.png"));
            return WaitFor(() =>
            {
                if (!File.Exists(path))
                {
                    // The key has no effect while the file is being loaded, so it is pressed until the image exists.
                    Send("key F12 sleep 0.5");
                    return null;
                }

                return ImageFile.Load(path);
            });
        }

        public int CloseWith(string commands)
        {
            Send(commands);
            Assert.True(_process.WaitForExit(Timeout), "the window did not close");
            return _process.ExitCode;
        }

        public void Dispose()
        {
            if (!_process.HasExited)
            {
                _process.Kill(entireProcessTree: true);
            }

            _process.Dispose();
        }

        private static string RunXdotool(string commands)
        {
            var start = new ProcessStartInfo("xdotool", commands) { RedirectStandardOutput = true, RedirectStandardError = true };
            using var tool = Process.Start(start)!;
            var output = tool.StandardOutput.ReadToEnd();
            tool.WaitForExit();
            return output;
        }
    }
}
