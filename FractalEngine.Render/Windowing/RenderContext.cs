using System.Globalization;
using FractalEngine.Render.Gl;
using FractalEngine.Render.Views;
using OpenTK.Graphics.OpenGL4;

namespace FractalEngine.Render.Windowing;

/// <summary>
/// An OpenGL context with the GL objects that belong to it. Renderers are created for a context and used on its thread. Dispose them
/// first, the context last.
/// </summary>
public abstract class RenderContext : IDisposable
{
    private static readonly Version MinVersion = new(3, 3);

    private readonly Action<string> _reportLeak;
    private bool _isDisposed;

    private protected RenderContext(PlatformWindow window, Action<string>? reportLeak)
    {
        Window = window;
        _reportLeak = reportLeak ?? Console.Error.WriteLine;
        Resources = new(() => window.IsCurrent);
        GL.GetInteger(GetPName.MajorVersion, out int major);
        GL.GetInteger(GetPName.MinorVersion, out int minor);
        GL.GetInteger(GetPName.MaxRenderbufferSize, out int maxFrameSize);
        GL.GetInteger(GetPName.MaxSamples, out int maxSampleCount);
        Version = new(major, minor);
        MaxFrameSize = maxFrameSize;
        MaxSampleCount = maxSampleCount;
        DriverName = string.Create(CultureInfo.InvariantCulture, $"OpenGL {major}.{minor}, {GL.GetString(StringName.Renderer)}");
        if (Version < MinVersion)
        {
            window.Dispose();
            throw new GraphicsUnavailableException($"OpenGL 3.3 is needed, but this system offers {DriverName}");
        }

        HasReversedDepth = Version >= new Version(4, 5) || HasExtension("GL_ARB_clip_control");
        if (HasReversedDepth)
        {
            window.UseZeroToOneDepth();
        }
    }

    /// <summary>OpenGL version of the driver, at least 3.3.</summary>
    public Version Version { get; }

    /// <summary>Version and renderer as the driver names them, for messages to the user.</summary>
    public string DriverName { get; }

    /// <summary>Maximum width and height of a frame in pixels.</summary>
    public int MaxFrameSize { get; }

    /// <summary>Maximum number of samples a pixel.</summary>
    public int MaxSampleCount { get; }

    /// <summary>
    /// True where depths run from 1 at the near plane to 0 at the far one. Single precision is finest near 0, and then separates depths
    /// that differ by about 1e-7 of themselves, however far apart the planes are.
    /// </summary>
    internal bool HasReversedDepth { get; }

    /// <summary>GL objects and bindings of the context.</summary>
    internal GlResources Resources { get; }

    private protected PlatformWindow Window { get; }

    /// <summary>Makes this the thread's current context, and deletes GL objects that were disposed on other threads.</summary>
    /// <exception cref="InvalidOperationException">This is not the thread that created the context.</exception>
    public void MakeCurrent()
    {
        ObjectDisposedException.ThrowIf(_isDisposed, this);
        Resources.RequireGlThread();
        Window.MakeCurrent();
        Resources.DeletePending();
    }

    /// <summary>Reports GL objects that are still alive by name, deletes them and ends the context. Harmless when repeated.</summary>
    public void Dispose()
    {
        if (_isDisposed)
        {
            return;
        }

        MakeCurrent();
        _isDisposed = true;
        var leaks = Resources.DeleteAll();
        Window.Dispose();
        GC.SuppressFinalize(this);
        // Last, since the caller's report may throw.
        foreach (var leak in leaks)
        {
            _reportLeak($"not disposed before its OpenGL context: {leak}");
        }
    }

    /// <summary>Switches the filters for redundant GL calls on or off.</summary>
    internal void ApplySettings(RenderSettings settings)
    {
        Resources.State.Filter.IsEnabled = settings.FilterRedundantState;
        Resources.UploadFilter.IsEnabled = settings.ReuseBuffers;
    }

    private static bool HasExtension(string name)
    {
        GL.GetInteger(GetPName.NumExtensions, out int count);
        return Enumerable.Range(0, count).Any(i => GL.GetString(StringNameIndexed.Extensions, i) == name);
    }
}
