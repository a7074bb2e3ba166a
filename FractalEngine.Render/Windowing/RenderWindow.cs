namespace FractalEngine.Render.Windowing;

/// <summary>
/// A window to draw into. It draws nothing by itself and never polls: the program waits for events and draws when the picture
/// has changed. Everything but <see cref="Wake"/> belongs to the thread that opened it.
/// </summary>
public sealed class RenderWindow : RenderContext
{
    private readonly List<WindowEvent> _events = [];

    /// <summary>Opens a window and makes its context current.</summary>
    /// <param name="title">Shown in the title bar.</param>
    /// <param name="width">Of the contents, pixels at the system's scale.</param>
    /// <param name="height">Of the contents.</param>
    /// <param name="reportLeak">Receives a line for each object that outlives the window; standard error when null.</param>
    /// <exception cref="GraphicsUnavailableException">There is no display, or no OpenGL 3.3.</exception>
    public RenderWindow(string title, int width, int height, Action<string>? reportLeak = null)
        : base(PlatformWindow.Open(title, width, height, isVisible: true), reportLeak)
    {
    }

    /// <summary>The width of the picture in pixels; 0 while the window is minimised on some systems.</summary>
    public int Width => Window.Width;

    /// <summary>The height of the picture in pixels.</summary>
    public int Height => Window.Height;

    /// <summary>Width divided by height; never 0.</summary>
    public double Aspect => (double)Math.Max(1, Width) / Math.Max(1, Height);

    /// <summary>Shown in the title bar.</summary>
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

    /// <summary>Hides the pointer and lets it move without end: for looking around with the mouse.</summary>
    public bool RelativeMouse
    {
        get => Window.RelativeMouse;
        set => Window.RelativeMouse = value;
    }

    /// <summary>Sleeps until something happens or <see cref="Wake"/> is called, and returns all that has happened.</summary>
    /// <param name="timeout">
    /// How long to sleep at most: <see cref="TimeSpan.Zero"/> only looks, <see cref="Timeout.InfiniteTimeSpan"/> never gives up.
    /// </param>
    /// <returns>In order; empty after a timeout or a wake-up. The list is reused by the next call.</returns>
    public IReadOnlyList<WindowEvent> WaitEvents(TimeSpan timeout)
    {
        Resources.RequireGlThread();
        _events.Clear();
        Window.WaitEvents(timeout, _events);
        return _events;
    }

    /// <summary>Ends the sleep of <see cref="WaitEvents"/>. The only member that other threads may call.</summary>
    public void Wake() => Window.Wake();

    /// <summary>Shows what was drawn into the window's own framebuffer.</summary>
    internal void SwapBuffers() => Window.SwapBuffers();
}
