using System.Diagnostics;
using FractalEngine.Render;
using FractalEngine.Render.Windowing;
using FractalEngine.Render.Windowing.Events;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Render.Windowing;

[Collection(GlTests.Name)]
public sealed class RenderWindowTests : IDisposable
{
    private readonly IDisposable _focus = Display.TakeFocus(GlTests.Name);

    public void Dispose() => _focus.Dispose();

    /// <summary>That nothing happens can't be waited for: this test waits, and measures the processor time of its own thread.</summary>
    [SkippableFact]
    public void WaitEvents_NothingHappens_SleepsUntilTheTimeoutWithoutWork()
    {
        using var window = Open();
        var timeout = TimeSpan.FromSeconds(1);
        Stopwatch clock;
        IReadOnlyList<WindowEvent> events;
        var deadline = Stopwatch.StartNew();
        do
        {
            // A window that was closed before this one opened may take the focus away late: then the silence begins anew.
            Drain(window);
            clock = Stopwatch.StartNew();
            // A loop that polls would take the processor all the time, or the share of it that a busy machine leaves.
            events = ProcessorTime.RunWithin(0.1, () => window.WaitEvents(timeout));
        }
        while (events is [FocusLost] && deadline.Elapsed < Polling.Deadline);
        Assert.Empty(events);
        // On a busy machine it may sleep longer, but never less, up to the rounding of the system's clocks.
        Assert.True(clock.Elapsed >= 0.9 * timeout, $"it slept for {clock.Elapsed} only");
    }

    [SkippableFact]
    public void ClipboardText_WhenSet_ReadsBack()
    {
        using var window = Open();
        window.ClipboardText = "c (1, 2, 3) (0, 0, 0) 60 größer";
        Assert.Equal("c (1, 2, 3) (0, 0, 0) 60 größer", window.ClipboardText);
    }

    [SkippableFact]
    public void Wake_FromAnotherThread_EndsTheSleep()
    {
        using var window = Open();
        Drain(window);
        const int Rounds = 100;
        var wokenCount = 0;
        using var isWaiting = new SemaphoreSlim(0);
        using var isAwake = new SemaphoreSlim(0);
        var other = new Thread(() =>
        {
            while (wokenCount < Rounds && isWaiting.Wait(Polling.Deadline))
            {
                // The pauses grow, so that some rounds wake the window just before it sleeps, and others while it does.
                Thread.SpinWait(200 * wokenCount);
                window.Wake();
                if (!isAwake.Wait(Polling.Deadline))
                {
                    return;
                }

                wokenCount++;
            }
        });
        other.Start();
        try
        {
            for (var round = 0; round < Rounds && other.IsAlive; round++)
            {
                isWaiting.Release();
                // A sleep that nothing ends takes longer than the other thread waits for its end.
                Assert.Empty(window.WaitEvents(2 * Polling.Deadline));
                isAwake.Release();
            }
        }
        finally
        {
            other.Join();
        }

        Assert.Equal(Rounds, wokenCount);
        Assert.Empty(window.WaitEvents(TimeSpan.Zero));
    }

    [SkippableFact]
    public void Drop_OfAFile_IsAnEvent()
    {
        using var window = Open();
        Drain(window);
        const string path = "/folder/größer.sdo";
        SdlQueue.Drop(path);
        Assert.Equal([new FileDropped(path)], window.WaitEvents(TimeSpan.Zero).OfType<FileDropped>());
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
