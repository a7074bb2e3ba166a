namespace FractalEngine.Render.Windowing;

/// <summary>A context without a visible window, for images that go to files. Any number of them can exist.</summary>
public sealed class OffscreenContext : RenderContext
{
    /// <summary>Creates a context and makes it current.</summary>
    /// <param name="reportLeak">Receives a line for each GL object that outlives the context; standard error when null.</param>
    /// <exception cref="GraphicsUnavailableException">There is no display, or no OpenGL 3.3.</exception>
    public OffscreenContext(Action<string>? reportLeak = null)
        : base(PlatformWindow.Open("FractalEngine", 16, 16, isVisible: false), reportLeak)
    {
    }
}
