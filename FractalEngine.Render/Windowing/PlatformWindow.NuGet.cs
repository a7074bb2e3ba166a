using OpenTK.Graphics.OpenGL4;
using OpenTK.Mathematics;
using OpenTK.Windowing.Common;
using OpenTK.Windowing.Desktop;
using OpenTK.Windowing.GraphicsLibraryFramework;

namespace FractalEngine.Render.Windowing;

/// <summary>A window of OpenTK 4.9.4, over GLFW.</summary>
internal sealed class PlatformWindow : IPlatformWindow
{
    private readonly NativeWindow _window;
    private readonly List<WindowEvent> _pending = [];
    private KeyModifiers _modifiers;

    private PlatformWindow(NativeWindow window)
    {
        _window = window;
        // Whether the window closes is the program's decision.
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
        window.MouseDown += button => AddButton(button, isDown: true);
        window.MouseUp += button => AddButton(button, isDown: false);
        window.MouseMove += AddMove;
        window.MouseWheel += wheel => _pending.Add(new WheelTurned(wheel.OffsetY, _modifiers));
    }

    public int Width => _window.FramebufferSize.X;

    public int Height => _window.FramebufferSize.Y;

    public string Title
    {
        get => _window.Title;
        set => _window.Title = value;
    }

    public bool RelativeMouse
    {
        get => _window.CursorState == CursorState.Grabbed;
        set => _window.CursorState = value ? CursorState.Grabbed : CursorState.Normal;
    }

    /// <summary>Pixels of the framebuffer for one unit of GLFW's coordinates: 2 on many screens of macOS.</summary>
    private Vector2 PixelScale => (_window.ClientSize, _window.FramebufferSize) switch
    {
        ({ X: > 0, Y: > 0 } client, var pixels) => new((float)pixels.X / client.X, (float)pixels.Y / client.Y),
        _ => Vector2.One,
    };

    /// <summary>Opens a window with an OpenGL 3.3 context.</summary>
    /// <exception cref="GraphicsUnavailableException">There is no display, or no OpenGL 3.3.</exception>
    public static PlatformWindow Open(string title, int width, int height, bool isVisible)
    {
        RequireDisplay();
        try
        {
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
                // Everything is drawn into a framebuffer of our own: the window's buffer only receives a copy.
                DepthBits = 0,
                StencilBits = 0,
            });
            return new(window);
        }
        catch (InvalidOperationException exception)
        {
            throw new GraphicsUnavailableException($"no OpenGL 3.3 on this display: {exception.Message}", exception);
        }
        catch (DllNotFoundException exception)
        {
            throw new GraphicsUnavailableException("GLFW is not installed (Debian: libglfw3)", exception);
        }
    }

    public void MakeCurrent()
    {
        if (!_window.Context.IsCurrent)
        {
            _window.MakeCurrent();
        }
    }

    public void UseZeroToOneDepth() => GL.ClipControl(ClipOrigin.LowerLeft, ClipDepthMode.ZeroToOne);

    public void SwapBuffers() => _window.Context.SwapBuffers();

    public void WaitEvents(TimeSpan timeout, List<WindowEvent> events)
    {
        _window.NewInputFrame();
        if (timeout > TimeSpan.Zero && _pending.Count == 0)
        {
            GLFW.WaitEventsTimeout(timeout.TotalSeconds);
        }

        // Takes what is left and rethrows what handlers threw; waits itself only when the caller sets no limit.
        NativeWindow.ProcessWindowEvents(waitForEvents: timeout < TimeSpan.Zero && _pending.Count == 0);
        events.AddRange(_pending);
        _pending.Clear();
    }

    public void Wake() => GLFW.PostEmptyEvent();

    public void Dispose() => _window.Dispose();

    /// <summary>
    /// Asks GLFW before OpenTK does: OpenTK's own error handler throws through native frames, which ends the process on Linux.
    /// </summary>
    private static void RequireDisplay()
    {
        try
        {
            // On macOS windows belong to the main thread; elsewhere any one thread will do, such as a test runner's.
            GLFWProvider.CheckForMainThread = OperatingSystem.IsMacOS();
            // Errors that matter are asked for where they arise; others (a window manager that refuses a position) change nothing.
            GLFWProvider.SetErrorCallback(static (_, _) => { });
            if (!GLFW.Init())
            {
                _ = GLFW.GetError(out var description);
                throw new GraphicsUnavailableException(
                    $"no display to draw on: {description} (without a screen, run under xvfb-run)");
            }
        }
        catch (Exception exception) when (exception is DllNotFoundException or TypeInitializationException)
        {
            throw new GraphicsUnavailableException("GLFW is not installed (Debian: libglfw3)", exception);
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
        // On X11 the state is that before the stroke: a modifier key's own stroke is not in it yet.
        var own = GlfwKeys.ModifierOf(key);
        _modifiers = (GlfwKeys.ModifiersOf(pressed.Modifiers) & ~own) | (isDown ? own : KeyModifiers.None);
        _pending.Add(isDown ? new KeyPressed(key, _modifiers, pressed.IsRepeat) : new KeyReleased(key, _modifiers));
    }

    private void AddMove(MouseMoveEventArgs move)
    {
        var scale = PixelScale;
        _pending.Add(new MouseMoved(scale.X * move.X, scale.Y * move.Y, scale.X * move.DeltaX, scale.Y * move.DeltaY));
    }

    private void AddButton(MouseButtonEventArgs button, bool isDown)
    {
        var (position, which, modifiers) =
            (_window.MousePosition * PixelScale, ButtonOf(button.Button), GlfwKeys.ModifiersOf(button.Modifiers));
        _pending.Add(isDown
            ? new MousePressed(which, position.X, position.Y, modifiers)
            : new MouseReleased(which, position.X, position.Y, modifiers));
    }

    private static MouseButton ButtonOf(OpenTK.Windowing.GraphicsLibraryFramework.MouseButton button) => button switch
    {
        OpenTK.Windowing.GraphicsLibraryFramework.MouseButton.Left => MouseButton.Left,
        OpenTK.Windowing.GraphicsLibraryFramework.MouseButton.Middle => MouseButton.Middle,
        OpenTK.Windowing.GraphicsLibraryFramework.MouseButton.Right => MouseButton.Right,
        _ => MouseButton.Other,
    };
}
