using System.Runtime.CompilerServices;
using System.Runtime.InteropServices;
using FractalEngine.Render.Windowing.Events;
using OpenTK;
using OpenTK.Graphics;

namespace FractalEngine.Render.Windowing;

/// <summary>A window of Debian's OpenTK 1.1, over SDL 2 on X11.</summary>
internal sealed class PlatformWindow : IDisposable
{
    private readonly NativeWindow _window;
    private readonly GraphicsContext _context;
    private readonly GCHandle _self;
    private readonly uint _id;
    private readonly List<WindowEvent> _pending = [];

    private PlatformWindow(NativeWindow window, GraphicsContext context, double contentScale)
    {
        ContentScale = contentScale;
        _window = window;
        _context = context;
        _id = SdlWindow.GetWindowId(window.WindowInfo.Handle);
        // OpenTK would destroy the window at once, but the program decides whether it closes.
        window.Closing += (_, closing) => closing.Cancel = true;
        _self = GCHandle.Alloc(this);
        unsafe
        {
            SdlWindow.AddEventWatch(&Watch, GCHandle.ToIntPtr(_self));
        }
    }

    /// <summary>Width of the framebuffer in pixels; 0 while the window is minimised on some systems.</summary>
    public int Width => _window.ClientSize.Width;

    /// <summary>Height of the framebuffer in pixels.</summary>
    public int Height => _window.ClientSize.Height;

    /// <summary>How large the system wants texts: 1 on a screen at 100 %.</summary>
    public double ContentScale { get; }

    /// <summary>Text in the title bar.</summary>
    public string Title
    {
        get => _window.Title;
        set => _window.Title = value;
    }

    /// <summary>Text of the system's clipboard; empty where it holds none.</summary>
    public string ClipboardText
    {
        get => SdlWindow.ReadClipboard();
        set => SdlWindow.SetClipboardText(value);
    }

    /// <summary>Whether the window fills the screen, without a frame.</summary>
    public bool IsFullScreen
    {
        get => _window.WindowState == WindowState.Fullscreen;
        set => _window.WindowState = value ? WindowState.Fullscreen : WindowState.Normal;
    }

    /// <summary>Opens a window with an OpenGL 3.3 context.</summary>
    /// <exception cref="GraphicsUnavailableException">There is no display, or no OpenGL 3.3.</exception>
    public static PlatformWindow Open(string title, int width, int height, bool isVisible)
    {
        RequireDisplay();
        NativeWindow? window = null;
        try
        {
            var scale = isVisible ? XResources.ReadContentScale() : 1;
            var mode = new GraphicsMode(new ColorFormat(8, 8, 8, 8), 0, 0, 0);
            window = new NativeWindow(
                (int)(width * scale), (int)(height * scale), title, GameWindowFlags.Default, mode, DisplayDevice.Default);
            var context = new GraphicsContext(mode, window.WindowInfo, 3, 3, GraphicsContextFlags.ForwardCompatible);
            context.MakeCurrent(window.WindowInfo);
            context.LoadAll();
            context.SwapInterval = isVisible ? 1 : 0;
            window.Visible = isVisible;
            return new(window, context, scale);
        }
        catch (GraphicsContextException exception)
        {
            window?.Dispose();
            throw new GraphicsUnavailableException($"no OpenGL 3.3 on this display: {exception.Message}", exception);
        }
    }

    /// <summary>Whether the window's context is the current one of the thread.</summary>
    public bool IsCurrent => _context.IsCurrent;

    /// <summary>Makes the window's context the current one of the thread.</summary>
    public void MakeCurrent()
    {
        if (!IsCurrent)
        {
            _context.MakeCurrent(_window.WindowInfo);
        }
    }

    /// <summary>
    /// Makes the clip planes of the window's context 0 and 1 rather than −1 and 1 (glClipControl). The context must be current.
    /// </summary>
    public unsafe void UseZeroToOneDepth()
    {
        // OpenTK 1.1 ends at OpenGL 4.4 and does not declare this function of 4.5.
        const uint lowerLeft = 0x8CA1;
        const uint zeroToOne = 0x935F;
        var address = ((IGraphicsContextInternal)_context).GetAddress("glClipControl");
        var clipControl = (delegate* unmanaged[Stdcall]<uint, uint, void>)address;
        clipControl(lowerLeft, zeroToOne);
    }

    /// <summary>Presents the window's framebuffer on the screen.</summary>
    public void SwapBuffers() => _context.SwapBuffers();

    /// <summary>Sleeps until an event arrives, then appends all events that have arrived.</summary>
    /// <param name="timeout">Longest time to sleep; zero only polls, a negative time sleeps without limit.</param>
    /// <param name="events">List that the events are appended to.</param>
    public void WaitEvents(TimeSpan timeout, List<WindowEvent> events)
    {
        // Another call that pumps, such as a change of the title, may have dispatched events already.
        if (_pending.Count == 0)
        {
            Sleep(timeout);
        }

        _window.ProcessEvents();
        // Events that OpenTK leaves in the queue would end every further sleep at once. The watch has seen them all.
        SdlWindow.FlushEvents(0, 0xFFFF);
        events.AddRange(_pending);
        _pending.Clear();
    }

    /// <summary>Ends the sleep of <see cref="WaitEvents"/>, from any thread.</summary>
    public unsafe void Wake()
    {
        var item = new SdlEvent { Type = SdlWindow.UserEvent };
        if (SdlWindow.PushEvent(&item) < 0)
        {
            throw new InvalidOperationException($"the window cannot be woken: {SdlWindow.ErrorText()}");
        }
    }

    public void Dispose()
    {
        unsafe
        {
            SdlWindow.DeleteEventWatch(&Watch, GCHandle.ToIntPtr(_self));
        }

        _self.Free();
        _context.Dispose();
        _window.Dispose();
    }

    /// <summary>Receives every event on the thread that queues it: the window's, or the one that calls <see cref="Wake"/>.</summary>
    [UnmanagedCallersOnly(CallConvs = [typeof(CallConvCdecl)])]
    private static unsafe int Watch(IntPtr data, SdlEvent* item)
    {
        if (item->Type != SdlWindow.UserEvent && GCHandle.FromIntPtr(data).Target is PlatformWindow window
            && SdlEventTranslator.Translate(*item, window._id) is { } translated)
        {
            window._pending.Add(translated);
        }

        return 1;
    }

    private static void Sleep(TimeSpan timeout)
    {
        var milliseconds = timeout < TimeSpan.Zero ? -1 : (int)Math.Min(Math.Ceiling(timeout.TotalMilliseconds), int.MaxValue);
        if (milliseconds != 0)
        {
            // Returns 0 after a timeout, which is no error.
            _ = SdlWindow.WaitEventTimeout(IntPtr.Zero, milliseconds);
        }
    }

    /// <summary>Initialises SDL before OpenTK does, which would fail in a static constructor and write to standard error.</summary>
    private static void RequireDisplay()
    {
        try
        {
            _ = SdlWindow.SetHint("SDL_VIDEODRIVER", "x11");
            if (SdlWindow.InitSubSystem(SdlWindow.InitVideo) != 0)
            {
                throw new GraphicsUnavailableException(
                    $"no display to draw on: {SdlWindow.ErrorText()} (without a screen, run under xvfb-run)");
            }
        }
        catch (DllNotFoundException exception)
        {
            throw new GraphicsUnavailableException("SDL 2 is not installed (Debian: libsdl2-2.0-0)", exception);
        }
    }
}
