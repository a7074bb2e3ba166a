using System.Globalization;
using FractalEngine.Render.Gl;
using OpenTK.Graphics.OpenGL4;

namespace FractalEngine.Render.Windowing;

/// <summary>
/// An OpenGL context and everything that lives in it. Renderers are made for a context and used on its thread; dispose
/// them first, the context last.
/// </summary>
public abstract class RenderContext : IDisposable
{
    private readonly Action<string> _reportLeak;
    private bool _isDisposed;

    private protected RenderContext(IPlatformWindow window, Action<string>? reportLeak)
    {
        (Window, _reportLeak) = (window, reportLeak ?? Console.Error.WriteLine);
        Resources = new();
        GL.GetInteger(GetPName.MajorVersion, out int major);
        GL.GetInteger(GetPName.MinorVersion, out int minor);
        GL.GetInteger(GetPName.MaxRenderbufferSize, out int size);
        GL.GetInteger(GetPName.MaxSamples, out int samples);
        (Version, MaxFrameSize, MaxSampleCount) = (new(major, minor), size, samples);
        DriverName = string.Create(CultureInfo.InvariantCulture, $"OpenGL {major}.{minor}, {GL.GetString(StringName.Renderer)}");
        if (Version < new Version(3, 3))
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

    /// <summary>What the driver implements: at least 3.3.</summary>
    public Version Version { get; }

    /// <summary>Version and renderer as the driver names them, for the user's eyes.</summary>
    public string DriverName { get; }

    /// <summary>The largest width and height of a picture, pixels.</summary>
    public int MaxFrameSize { get; }

    /// <summary>The most samples a pixel.</summary>
    public int MaxSampleCount { get; }

    /// <summary>The labels of the GL objects that are not disposed, sorted.</summary>
    public IReadOnlyList<string> LiveObjects => Resources.LiveObjects;

    /// <summary>
    /// True where depths run from 1 at the near plane to 0 at the far one: single precision, which is finest about 0, then tells apart
    /// depths that differ by about 1e-7 of themselves, however far the planes are apart.
    /// </summary>
    internal bool HasReversedDepth { get; }

    internal GlResources Resources { get; }

    private protected IPlatformWindow Window { get; }

    private static bool HasExtension(string name)
    {
        GL.GetInteger(GetPName.NumExtensions, out int count);
        return Enumerable.Range(0, count).Any(i => GL.GetString(StringNameIndexed.Extensions, i) == name);
    }

    /// <summary>Makes this the thread's current context, and deletes what was disposed on other threads meanwhile.</summary>
    public void MakeCurrent()
    {
        ObjectDisposedException.ThrowIf(_isDisposed, this);
        Resources.RequireGlThread();
        Window.MakeCurrent();
        Resources.DeletePending();
    }

    /// <summary>Takes over which GL calls are left out.</summary>
    internal void ApplySettings(RenderSettings settings) =>
        (Resources.State.Filter.IsEnabled, Resources.UploadFilter.IsEnabled) = (settings.FilterRedundantState, settings.ReuseBuffers);

    /// <summary>Reports what is still alive by name, deletes it and ends the context. Harmless when repeated.</summary>
    public void Dispose()
    {
        if (_isDisposed)
        {
            return;
        }

        MakeCurrent();
        _isDisposed = true;
        foreach (var leak in Resources.DeleteAll())
        {
            _reportLeak($"not disposed before its OpenGL context: {leak}");
        }

        Window.Dispose();
        GC.SuppressFinalize(this);
    }
}
