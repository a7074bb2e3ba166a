namespace FractalEngine.Render.Windowing;

/// <summary>
/// A window with a GL context, as each of the two assemblies named OpenTK provides it. <c>PlatformWindow</c> implements it twice;
/// the build takes one. All members but <see cref="Wake"/> belong to the thread that made the window.
/// </summary>
internal interface IPlatformWindow : IDisposable
{
    /// <summary>The framebuffer's width in pixels; 0 while minimised on some systems.</summary>
    int Width { get; }

    /// <summary>The framebuffer's height in pixels.</summary>
    int Height { get; }

    /// <summary>Shown in the title bar.</summary>
    string Title { get; set; }

    /// <summary>Hides the pointer and lets it move without end.</summary>
    bool RelativeMouse { get; set; }

    /// <summary>
    /// Lets depths in the window's context end at 0 and 1 rather than −1 and 1 (glClipControl). The context must be current.
    /// </summary>
    void UseZeroToOneDepth();

    /// <summary>Makes the window's context the thread's current one.</summary>
    void MakeCurrent();

    /// <summary>Shows what was drawn into the window's framebuffer.</summary>
    void SwapBuffers();

    /// <summary>Sleeps until something happens, then appends everything that did.</summary>
    /// <param name="timeout">How long to sleep at most; zero only polls, negative sleeps without end.</param>
    /// <param name="events">Is appended to.</param>
    void WaitEvents(TimeSpan timeout, List<WindowEvent> events);

    /// <summary>Ends the sleep of <see cref="WaitEvents"/>, from any thread.</summary>
    void Wake();
}
