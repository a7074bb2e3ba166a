using System.Diagnostics;
using FractalEngine.Render;
using FractalEngine.Render.Windowing;

namespace FractalEngine.Tests.Render.Windowing;

[Collection(GlTests.Name)]
public sealed class RenderWindowTests
{
    private const double Timeout = 1;
    private const double MaxWork = 0.5 * Timeout;

    [SkippableFact]
    public void WaitEvents_NothingHappens_SleepsUntilTheTimeoutWithoutWork()
    {
        using var window = Open();
        Drain(window);
        // A loop that polls takes processor time in each attempt. The compiler and the test host, which share the process, do not.
        var leastWork = double.PositiveInfinity;
        for (var attempt = 0; attempt < 3 && leastWork > MaxWork; attempt++)
        {
            var clock = Stopwatch.StartNew();
            var before = Process.GetCurrentProcess().TotalProcessorTime;
            Assert.Empty(window.WaitEvents(TimeSpan.FromSeconds(Timeout)));
            Assert.InRange(clock.Elapsed.TotalSeconds, 0.9 * Timeout, 10);
            leastWork = Math.Min(leastWork, (Process.GetCurrentProcess().TotalProcessorTime - before).TotalSeconds);
        }

        Assert.InRange(leastWork, 0, MaxWork);
    }

    [SkippableFact]
    public void Wake_FromAnotherThread_EndsTheSleep()
    {
        using var window = Open();
        Drain(window);
        var other = new Thread(() =>
        {
            Thread.Sleep(100);
            window.Wake();
        });
        var clock = Stopwatch.StartNew();
        other.Start();
        Assert.Empty(window.WaitEvents(TimeSpan.FromSeconds(20)));
        Assert.InRange(clock.Elapsed.TotalSeconds, 0, 10);
        other.Join();
        Assert.Empty(window.WaitEvents(TimeSpan.Zero));
    }

    [SkippableFact]
    public void Present_Frame_KeepsIt()
    {
        using var window = Open();
        using var frame = new FrameRenderer(window);
        Drain(window);
        frame.Draw(null, RenderScenes.FrontView, window.Width, window.Height, new() { Background = new(0.2, 0.4, 0.6) });
        frame.Present(window);
        frame.Present(window);
        window.Resources.ThrowOnError("presenting");
        Assert.Equal((51, 102, 153, 255), frame.Capture()[10, 10]);
        Assert.Equal((320, 240), (window.Width, window.Height));
    }

    [SkippableFact]
    public void Title_Set_IsKept()
    {
        using var window = Open();
        window.Title = "another · title";
        Assert.Equal("another · title", window.Title);
    }

    private static RenderWindow Open()
    {
        try
        {
            return new("test", 320, 240, leak => throw new InvalidOperationException(leak));
        }
        catch (GraphicsUnavailableException exception)
        {
            throw new SkipException(exception.Message);
        }
    }

    /// <summary>Drops the events of opening: shown, exposed, the pointer inside.</summary>
    private static void Drain(RenderWindow window)
    {
        while (window.WaitEvents(TimeSpan.FromSeconds(0.2)).Count > 0)
        {
        }
    }
}
