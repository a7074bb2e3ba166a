using System.Runtime.CompilerServices;
using System.Runtime.InteropServices;
using OpenTK;
using OpenTK.Graphics;

namespace FractalEngine.Render.Windowing;

/// <summary>A window of Debian's OpenTK 1.1, over SDL 2 on X11.</summary>
internal sealed class PlatformWindow : IPlatformWindow
{
    private readonly NativeWindow _window;
    private readonly GraphicsContext _context;
    private readonly GCHandle _self;
    private readonly uint _id;
    private readonly List<WindowEvent> _pending = [];
    private bool _relativeMouse;

    private PlatformWindow(NativeWindow window, GraphicsContext context)
    {
        (_window, _context) = (window, context);
        _id = SdlWindow.GetWindowId(window.WindowInfo.Handle);
        // OpenTK would destroy the window at once; whether it closes is the program's decision.
        window.Closing += (_, closing) => closing.Cancel = true;
        _self = GCHandle.Alloc(this);
        unsafe
        {
            SdlWindow.AddEventWatch(&Watch, GCHandle.ToIntPtr(_self));
        }
    }

    public int Width => _window.ClientSize.Width;

    public int Height => _window.ClientSize.Height;

    public string Title
    {
        get => _window.Title;
        set => _window.Title = value;
    }

    public bool RelativeMouse
    {
        get => _relativeMouse;
        set => _relativeMouse = SdlWindow.SetRelativeMouseMode(value ? 1 : 0) == 0 && value;
    }

    /// <summary>Opens a window with an OpenGL 3.3 context.</summary>
    /// <exception cref="GraphicsUnavailableException">There is no display, or no OpenGL 3.3.</exception>
    public static PlatformWindow Open(string title, int width, int height, bool isVisible)
    {
        RequireDisplay();
        NativeWindow? window = null;
        try
        {
            var mode = new GraphicsMode(new ColorFormat(8, 8, 8, 8), 0, 0, 0);
            window = new NativeWindow(width, height, title, GameWindowFlags.Default, mode, DisplayDevice.Default);
            var context = new GraphicsContext(mode, window.WindowInfo, 3, 3, GraphicsContextFlags.ForwardCompatible);
            context.MakeCurrent(window.WindowInfo);
            context.LoadAll();
            context.SwapInterval = isVisible ? 1 : 0;
            window.Visible = isVisible;
            return new(window, context);
        }
        catch (GraphicsContextException exception)
        {
            window?.Dispose();
            throw new GraphicsUnavailableException($"no OpenGL 3.3 on this display: {exception.Message}", exception);
        }
    }

    public void MakeCurrent()
    {
        if (!_context.IsCurrent)
        {
            _context.MakeCurrent(_window.WindowInfo);
        }
    }

    public unsafe void UseZeroToOneDepth()
    {
        // OpenTK 1.1 ends at OpenGL 4.4 and does not know this one.
        const uint lowerLeft = 0x8CA1;
        const uint zeroToOne = 0x935F;
        ((delegate* unmanaged[Stdcall]<uint, uint, void>)((IGraphicsContextInternal)_context).GetAddress("glClipControl"))(lowerLeft,
            zeroToOne);
    }

    public void SwapBuffers() => _context.SwapBuffers();

    public void WaitEvents(TimeSpan timeout, List<WindowEvent> events)
    {
        // Events were perhaps dispatched by another call that pumps, such as a change of the title.
        if (_pending.Count == 0)
        {
            Sleep(timeout);
        }

        _window.ProcessEvents();
        // Whatever OpenTK leaves in the queue would end every further sleep at once; the watch has seen it all.
        SdlWindow.FlushEvents(0, 0xFFFF);
        events.AddRange(_pending);
        _pending.Clear();
    }

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

    /// <summary>SDL shows every event here first, on the thread that queues it: that of <see cref="Wake"/>'s caller, or ours.</summary>
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
            // 0 says that the time is over: nothing has happened, which is no error.
            _ = SdlWindow.WaitEventTimeout(IntPtr.Zero, milliseconds);
        }
    }

    /// <summary>Asks SDL before OpenTK does: OpenTK fails in a static constructor, with lines of its own on standard error.</summary>
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
