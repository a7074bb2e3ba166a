using FractalEngine.Render.Windowing.Events;
using FractalEngine.Render.Windowing.Keyboard;
using OpenTK.Graphics.OpenGL4;
using OpenTK.Mathematics;
using OpenTK.Windowing.Common;
using OpenTK.Windowing.Desktop;
using OpenTK.Windowing.GraphicsLibraryFramework;
using GlfwButton = OpenTK.Windowing.GraphicsLibraryFramework.MouseButton;
using KeyModifiers = FractalEngine.Render.Windowing.Keyboard.KeyModifiers;
using MouseButton = FractalEngine.Render.Windowing.Keyboard.MouseButton;

namespace FractalEngine.Render.Windowing;

/// <summary>A window of OpenTK 4.9.4 from NuGet, over GLFW.</summary>
internal sealed class PlatformWindow : IDisposable
{
    private readonly NativeWindow _window;
    private readonly List<WindowEvent> _pending = [];
    private KeyModifiers _modifiers;

    private PlatformWindow(NativeWindow window)
    {
        _window = window;
        // The program decides whether the window closes.
        window.Closing += closing =>
        {
            closing.Cancel = true;
            _pending.Add(new CloseRequested());
        };
        window.Refresh += () => _pending.Add(new WindowExposed());
        window.FramebufferResize += size => _pending.Add(new WindowResized(size.Width, size.Height));
        window.Minimized += minimized => _pending.Add(new VisibilityChanged(!minimized.IsMinimized));
        window.FocusedChanged += LoseFocus;
        window.FileDrop += dropped => _pending.AddRange(dropped.FileNames.Select(file => new FileDropped(file)));
        window.KeyDown += key => AddKey(key, isDown: true);
        window.KeyUp += key => AddKey(key, isDown: false);
        window.TextInput += text => _pending.Add(new TextEntered(text.AsString));
        window.MouseDown += button => AddButton(button, isDown: true);
        window.MouseUp += button => AddButton(button, isDown: false);
        window.MouseMove += AddMove;
        window.MouseWheel += wheel => _pending.Add(new WheelTurned(wheel.OffsetY, _modifiers));
    }

    /// <summary>Width of the framebuffer in pixels; 0 while the window is minimised on some systems.</summary>
    public int Width => _window.FramebufferSize.X;

    /// <summary>Height of the framebuffer in pixels.</summary>
    public int Height => _window.FramebufferSize.Y;

    /// <summary>How large the system wants texts: 1 on a screen at 100 %.</summary>
    public unsafe double ContentScale
    {
        get
        {
            GLFW.GetWindowContentScale(_window.WindowPtr, out var scale, out _);
            return scale;
        }
    }

    /// <summary>Text in the title bar.</summary>
    public string Title
    {
        get => _window.Title;
        set => _window.Title = value;
    }

    /// <summary>Text of the system's clipboard; empty where it holds none.</summary>
    public string ClipboardText
    {
        get => _window.ClipboardString ?? "";
        set => _window.ClipboardString = value;
    }

    /// <summary>Whether the window fills the screen, without a frame.</summary>
    public bool IsFullScreen
    {
        get => _window.WindowState == WindowState.Fullscreen;
        set => _window.WindowState = value ? WindowState.Fullscreen : WindowState.Normal;
    }

    /// <summary>Framebuffer pixels per screen point, which is GLFW's unit: 2 on many screens of macOS.</summary>
    private Vector2 PixelsPerPoint
    {
        get
        {
            var points = _window.ClientSize;
            var pixels = _window.FramebufferSize;
            return points is { X: > 0, Y: > 0 } ? new((float)pixels.X / points.X, (float)pixels.Y / points.Y) : Vector2.One;
        }
    }

    /// <summary>Opens a window with an OpenGL 3.3 context.</summary>
    /// <exception cref="GraphicsUnavailableException">
    /// There is no display, no OpenGL 3.3 or no GLFW, or this is not the main thread on macOS.
    /// </exception>
    public static PlatformWindow Open(string title, int width, int height, bool isVisible)
    {
        try
        {
            InitialiseGlfw();
            // On Windows and X11 the size is in pixels: text would be half as large as elsewhere on a screen at 200 %.
            GLFW.WindowHint(WindowHintBool.ScaleToMonitor, isVisible);
            var window = new NativeWindow(new NativeWindowSettings
            {
                Title = title,
                ClientSize = new(width, height),
                StartVisible = isVisible,
                StartFocused = isVisible,
                APIVersion = new Version(3, 3),
                Profile = ContextProfile.Core,
                Flags = ContextFlags.ForwardCompatible,
                Vsync = isVisible ? VSyncMode.On : VSyncMode.Off,
                // Frames are drawn into a framebuffer of our own, and the window's only receives a copy.
                DepthBits = 0,
                StencilBits = 0,
            });
            return new(window);
        }
        catch (InvalidOperationException exception)
        {
            throw new GraphicsUnavailableException($"no OpenGL 3.3 on this display: {exception.Message}", exception);
        }
        catch (GLFWException exception)
        {
            throw new GraphicsUnavailableException($"no window can be opened here: {exception.Message}", exception);
        }
        catch (Exception exception) when (exception is DllNotFoundException or TypeInitializationException)
        {
            throw new GraphicsUnavailableException("GLFW is not installed (Debian: libglfw3)", exception);
        }
    }

    /// <summary>Whether the window's context is the current one of the thread.</summary>
    public bool IsCurrent => _window.Context.IsCurrent;

    /// <summary>Makes the window's context the current one of the thread.</summary>
    public void MakeCurrent()
    {
        if (!IsCurrent)
        {
            _window.MakeCurrent();
        }
    }

    /// <summary>
    /// Makes the clip planes of the window's context 0 and 1 rather than −1 and 1 (glClipControl). The context must be current.
    /// </summary>
    public void UseZeroToOneDepth() => GL.ClipControl(ClipOrigin.LowerLeft, ClipDepthMode.ZeroToOne);

    /// <summary>Presents the window's framebuffer on the screen.</summary>
    public void SwapBuffers() => _window.Context.SwapBuffers();

    /// <summary>Sleeps until an event arrives, then appends all events that have arrived.</summary>
    /// <param name="timeout">Longest time to sleep; zero only polls, a negative time sleeps without limit.</param>
    /// <param name="events">List that the events are appended to.</param>
    public void WaitEvents(TimeSpan timeout, List<WindowEvent> events)
    {
        _window.NewInputFrame();
        if (timeout > TimeSpan.Zero && _pending.Count == 0)
        {
            GLFW.WaitEventsTimeout(timeout.TotalSeconds);
        }

        // Dispatches the remaining events and rethrows exceptions of handlers. Waits itself only if the caller sets no limit.
        NativeWindow.ProcessWindowEvents(waitForEvents: timeout < TimeSpan.Zero && _pending.Count == 0);
        events.AddRange(_pending);
        _pending.Clear();
    }

    /// <summary>Ends the sleep of <see cref="WaitEvents"/>, from any thread.</summary>
    public void Wake() => GLFW.PostEmptyEvent();

    public void Dispose() => _window.Dispose();

    /// <summary>
    /// Initialises GLFW before OpenTK opens a window: OpenTK's own error handler throws through native frames, which ends the process on
    /// Linux.
    /// </summary>
    private static void InitialiseGlfw()
    {
        // Windows belong to the main thread on macOS. Elsewhere any one thread will do, such as a test runner's.
        GLFWProvider.CheckForMainThread = OperatingSystem.IsMacOS();
        // Failures are queried where they occur. Other errors, such as a window manager that refuses a position, have no effect.
        GLFWProvider.SetErrorCallback(static (_, _) => { });
        // Throws on another thread than the main one, before GLFW itself is called: macOS would end the process.
        GLFWProvider.EnsureInitialized();
        // OpenTK ignores whether that succeeded.
        if (!GLFW.Init())
        {
            _ = GLFW.GetError(out var description);
            throw new GraphicsUnavailableException($"no display to draw on: {description} (without a screen, run under xvfb-run)");
        }
    }

    private void LoseFocus(FocusedChangedEventArgs change)
    {
        if (!change.IsFocused)
        {
            _modifiers = KeyModifiers.None;
            _pending.Add(new FocusLost());
        }
    }

    private void AddKey(KeyboardKeyEventArgs pressed, bool isDown)
    {
        var key = GlfwKeys.KeyOf(pressed.Key, pressed.ScanCode);
        // On X11 the state is that before the stroke, without the effect of a modifier key itself.
        var ownModifier = GlfwKeys.ModifierOf(key);
        _modifiers = (GlfwKeys.ModifiersOf(pressed.Modifiers) & ~ownModifier) | (isDown ? ownModifier : KeyModifiers.None);
        _pending.Add(isDown ? new KeyPressed(key, _modifiers, pressed.IsRepeat) : new KeyReleased(key, _modifiers));
    }

    private void AddMove(MouseMoveEventArgs move)
    {
        var position = move.Position * PixelsPerPoint;
        _pending.Add(new MouseMoved(position.X, position.Y, move.DeltaX, move.DeltaY));
    }

    private void AddButton(MouseButtonEventArgs pressed, bool isDown)
    {
        var button = ButtonOf(pressed.Button);
        var position = _window.MousePosition * PixelsPerPoint;
        var modifiers = GlfwKeys.ModifiersOf(pressed.Modifiers);
        _pending.Add(isDown
            ? new MousePressed(button, position.X, position.Y, modifiers)
            : new MouseReleased(button, position.X, position.Y, modifiers));
    }

    private static MouseButton ButtonOf(GlfwButton button) => button switch
    {
        GlfwButton.Left => MouseButton.Left,
        GlfwButton.Middle => MouseButton.Middle,
        GlfwButton.Right => MouseButton.Right,
        _ => MouseButton.Other,
    };
}
