using System.Diagnostics;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.App.Window;

/// <summary>Tests the full screen under a window manager, without which no window can leave it again.</summary>
[Collection(DrivenWindow.Collection)]
public sealed class FullScreenTests : IDisposable
{
    private readonly TemporaryFolder _folder = new();

    public void Dispose() => _folder.Dispose();

    [SkippableFact]
    [Trait("Category", "Soak")]
    public void FullScreen_ByItsKey_FillsTheScreenAndReturns()
    {
        Display.Require();
        var path = (Environment.GetEnvironmentVariable("PATH") ?? "").Split(Path.PathSeparator);
        Skip.IfNot(path.Any(static folder => File.Exists(Path.Combine(folder, "openbox"))), "openbox is not installed");
        using var manager = Process.Start("openbox", ["--sm-disable"]);
        try
        {
            Polling.WaitUntil(static () => DrivenWindow.RunXdotool("get_desktop").Trim() == "0", "window manager");
            _folder.Write("cube.obj", SampleFiles.Cube);
            using var window = DrivenWindow.Open(_folder, "cube.obj", "--resolution", "500x400");
            Polling.WaitUntil(() => window.Size == (500, 400), "window");
            window.Send("windowactivate --sync {window}");
            window.Send("key F11");
            Polling.WaitUntil(() => window.Size is { Width: > 900, Height: > 700 }, "full screen");
            var (width, height) = window.Size;
            Polling.WaitUntil(() => window.Screenshot() is var image && (image.Width, image.Height) == (width, height), "large frame");
            window.Send("key F11");
            Polling.WaitUntil(() => window.Size == (500, 400), "window again");
            Polling.WaitUntil(() => window.Screenshot() is { Width: 500, Height: 400 }, "frame again");
            Assert.Equal(0, window.CloseWith("key Escape"));
        }
        finally
        {
            manager.Kill();
            manager.WaitForExit();
        }
    }
}
