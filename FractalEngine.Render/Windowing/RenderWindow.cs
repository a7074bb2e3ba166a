using FractalEngine.Render.Windowing.Events;

namespace FractalEngine.Render.Windowing;

/// <summary>
/// A window to present frames in. It draws nothing by itself and never polls: the program waits for events, and draws when the frame has
/// changed. All members except <see cref="Wake"/> belong to the thread that opened the window.
/// </summary>
public sealed class RenderWindow : RenderContext
{
    private readonly List<WindowEvent> _events = [];

    /// <summary>Opens a window and makes its context current.</summary>
    /// <param name="title">Text in the title bar.</param>
    /// <param name="width">Width of the contents, in pixels of a screen at 100 %. It is scaled up on denser screens.</param>
    /// <param name="height">Height of the contents, in the same unit.</param>
    /// <param name="reportLeak">Receives a line for each GL object that outlives the window; standard error when null.</param>
    /// <exception cref="GraphicsUnavailableException">There is no display, or no OpenGL 3.3.</exception>
    public RenderWindow(string title, int width, int height, Action<string>? reportLeak = null)
        : base(PlatformWindow.Open(title, width, height, isVisible: true), reportLeak)
    {
    }

    /// <summary>Width of the framebuffer in pixels; 0 while the window is minimised on some systems.</summary>
    public int Width => Window.Width;

    /// <summary>Height of the framebuffer in pixels; 0 while the window is minimised on some systems.</summary>
    public int Height => Window.Height;

    /// <summary>Width divided by height of the framebuffer, never 0.</summary>
    public double Aspect => (double)Math.Max(1, Width) / Math.Max(1, Height);

    /// <summary>How large the system wants texts: 1 on a screen at 100 %, 2 at 200 %. It may change as the window is moved.</summary>
    public double ContentScale => Window.ContentScale;

    /// <summary>Text in the title bar.</summary>
    public string Title
    {
        get => Window.Title;
        set
        {
            if (Window.Title != value)
            {
                Window.Title = value;
            }
        }
    }

    /// <summary>Text of the system's clipboard; empty where it holds none.</summary>
    public string ClipboardText
    {
        get => Window.ClipboardText;
        set => Window.ClipboardText = value;
    }

    /// <summary>Whether the window fills the screen, without a frame. The system may refuse it.</summary>
    public bool IsFullScreen
    {
        get => Window.IsFullScreen;
        set => Window.IsFullScreen = value;
    }

    /// <summary>Sleeps until an event arrives or <see cref="Wake"/> is called, and returns all events that have arrived.</summary>
    /// <param name="timeout">
    /// Longest time to sleep: <see cref="TimeSpan.Zero"/> only polls, <see cref="Timeout.InfiniteTimeSpan"/> sleeps without limit.
    /// </param>
    /// <returns>Events in their order; none after a timeout or a wake-up. The next call reuses the list.</returns>
    public IReadOnlyList<WindowEvent> WaitEvents(TimeSpan timeout)
    {
        Resources.RequireGlThread();
        _events.Clear();
        Window.WaitEvents(timeout, _events);
        return _events;
    }

    /// <summary>Ends the sleep of <see cref="WaitEvents"/>. Other threads may call only this member.</summary>
    public void Wake() => Window.Wake();

    /// <summary>Presents the window's own framebuffer on the screen.</summary>
    internal void SwapBuffers() => Window.SwapBuffers();
}
