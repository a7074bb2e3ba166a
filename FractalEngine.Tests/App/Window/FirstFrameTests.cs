using System.Diagnostics;
using System.Globalization;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.App.Window;

/// <summary>Measures the time from the start of the program until a scene is on the screen.</summary>
[Collection(TimedTests.Name)]
public sealed class FirstFrameTests : IDisposable
{
    // Brighter than the dark background of a window without a scene, darker than the sky of the gallery.
    private const int SceneBrightness = 90;

    private readonly TemporaryFolder _folder = new();

    public void Dispose() => _folder.Dispose();

    /// <summary>
    /// 1.0 s on two quiet cores without a GPU, though what is built for tests is not compiled ahead of time. It was 3.9 s before the first
    /// frame became a preview. The limit leaves room for other work on the machine.
    /// </summary>
    [SkippableFact]
    [Trait("Category", "Soak")]
    public void View_OfTheGallery_IsOnTheScreenSoon()
    {
        Display.Require();
        using var screen = new ScreenPixel();
        Skip.IfNot(screen.IsAvailable && screen.Brightness(640, 360) < SceneBrightness, "the screen shows something else");
        var times = Enumerable.Range(0, 3).Select(_ => TimeFirstFrame(screen).TotalSeconds).ToList();
        var all = string.Join(' ', times.Select(static time => time.ToString("F2", CultureInfo.InvariantCulture)));
        Console.WriteLine($"seconds to the first frame: {all}");
        Assert.True(times.Min() < 4, $"seconds to the first frame: {all}");
    }

    private TimeSpan TimeFirstFrame(ScreenPixel screen)
    {
        var environment = new Dictionary<string, string?>
        {
            ["FRACTALENGINE_NO_WINDOW"] = null,
            ["XDG_CONFIG_HOME"] = _folder["config"],
        };
        var clock = Stopwatch.StartNew();
        using var program = AppProcess.Start(
            _folder.Path, environment, "view", Repository.Full("assets/scenes/gallery.sdo"), "--resolution", "1280x720", "--no-trace");
        try
        {
            Polling.WaitUntil(() => screen.Brightness(640, 360) >= SceneBrightness, "the scene");
            return clock.Elapsed;
        }
        finally
        {
            program.Kill(entireProcessTree: true);
            program.WaitForExit();
            Polling.WaitUntil(() => screen.Brightness(640, 360) < SceneBrightness, "the empty screen");
        }
    }
}
