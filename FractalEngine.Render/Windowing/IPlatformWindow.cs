using FractalEngine.Render.Windowing.Events;

namespace FractalEngine.Render.Windowing;

/// <summary>
/// A window with a GL context. <c>PlatformWindow</c> implements it for each of the two assemblies named OpenTK, and the build takes one of
/// the two. All members except <see cref="Wake"/> belong to the thread that opened the window.
/// </summary>
internal interface IPlatformWindow : IDisposable
{
    /// <summary>Width of the framebuffer in pixels; 0 while the window is minimised on some systems.</summary>
    int Width { get; }

    /// <summary>Height of the framebuffer in pixels.</summary>
    int Height { get; }

    /// <summary>Text in the title bar.</summary>
    string Title { get; set; }

    /// <summary>Text of the system's clipboard; empty where it holds none.</summary>
    string ClipboardText { get; set; }

    /// <summary>Whether the window fills the screen, without a frame.</summary>
    bool IsFullScreen { get; set; }

    /// <summary>
    /// Makes the clip planes of the window's context 0 and 1 rather than −1 and 1 (glClipControl). The context must be current.
    /// </summary>
    void UseZeroToOneDepth();

    /// <summary>Makes the window's context the current one of the thread.</summary>
    void MakeCurrent();

    /// <summary>Presents the window's framebuffer on the screen.</summary>
    void SwapBuffers();

    /// <summary>Sleeps until an event arrives, then appends all events that have arrived.</summary>
    /// <param name="timeout">Longest time to sleep; zero only polls, a negative time sleeps without limit.</param>
    /// <param name="events">List that the events are appended to.</param>
    void WaitEvents(TimeSpan timeout, List<WindowEvent> events);

    /// <summary>Ends the sleep of <see cref="WaitEvents"/>, from any thread.</summary>
    void Wake();
}
