using System.Diagnostics;
using FractalEngine.Render;
using FractalEngine.Render.Windowing;

namespace FractalEngine.Tests.Render;

[Collection(GlTests.Name)]
public sealed class RenderWindowTests
{
    [SkippableFact]
    public void WaitEvents_NothingHappens_SleepsUntilTheTimeoutWithoutWork()
    {
        using var window = Open();
        Drain(window);
        var (clock, before) = (Stopwatch.StartNew(), Process.GetCurrentProcess().TotalProcessorTime);
        Assert.Empty(window.WaitEvents(TimeSpan.FromSeconds(1.5)));
        Assert.InRange(clock.Elapsed.TotalSeconds, 1.4, 10);
        // A loop that polls would take all of the time; the compiler and the test host work beside us now and then.
        Assert.InRange((Process.GetCurrentProcess().TotalProcessorTime - before).TotalSeconds, 0, 0.8);
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
    public void Present_Frame_IsShownAndKept()
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

    /// <summary>Lets the events of opening pass: shown, exposed, the pointer within.</summary>
    private static void Drain(RenderWindow window)
    {
        while (window.WaitEvents(TimeSpan.FromSeconds(0.2)).Count > 0)
        {
        }
    }
}
