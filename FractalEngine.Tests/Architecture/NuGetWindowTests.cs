using FractalEngine.Core;
using FractalEngine.Render;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Architecture;

/// <summary>The files for OpenTK 4.9.4, which a build with Debian's OpenTK leaves out, compile.</summary>
public class NuGetWindowTests
{
    // What they use of OpenTK 4.9.4, and its public names that are also names of the engine. Bodies don't matter.
    private const string Declarations =
        """
        global using System;
        global using System.Collections.Generic;
        global using System.Linq;

        namespace OpenTK.Mathematics
        {
            public struct Vector2(float x, float y)
            {
                public float X = x, Y = y;
                public static Vector2 One => default;
                public static Vector2 operator *(Vector2 a, Vector2 b) => a;
            }

            public struct Vector2i(int x, int y)
            {
                public int X = x, Y = y;
            }
        }

        namespace OpenTK.Graphics.OpenGL4
        {
            public enum ClipOrigin { LowerLeft }
            public enum ClipDepthMode { ZeroToOne }
            public enum PolygonMode { Line, Fill }
            public enum TriangleFace { Front, Back, FrontAndBack }
            public enum EnableCap { CullFace }

            public sealed class GL
            {
                public static void ClipControl(ClipOrigin origin, ClipDepthMode depth) { }
                public static void PolygonMode(TriangleFace face, PolygonMode mode) { }
                public static void CullFace(TriangleFace mode) { }
            }
        }

        namespace OpenTK.Windowing.GraphicsLibraryFramework
        {
            [Flags] public enum KeyModifiers { Shift = 1, Control = 2, Alt = 4 }
            public enum Keys
            {
                Unknown = -1, Equal = 61, D0 = 48, D9 = 57, Escape = 256, KeyPad0 = 320, KeyPad9 = 329, KeyPadSubtract = 333, KeyPadAdd,
                KeyPadEnter,
            }
            public enum MouseButton { Left, Right, Middle }
            public enum WindowHintBool { ScaleToMonitor }
            public enum ErrorCode { NoError }
            public struct Window;
            public class GLFWException : Exception;
            public class GLFWCallbacks { public delegate void ErrorCallback(ErrorCode error, string description); }

            public static unsafe class GLFW
            {
                public static void GetWindowContentScale(Window* window, out float x, out float y) => throw new();
                public static bool Init() => true;
                public static ErrorCode GetError(out string description) => throw new();
                public static string GetKeyName(Keys key, int scanCode) => "";
                public static void WindowHint(WindowHintBool hint, bool value) { }
                public static void WaitEventsTimeout(double timeout) { }
                public static void PostEmptyEvent() { }
            }
        }

        namespace OpenTK.Windowing.Common
        {
            using OpenTK.Mathematics;
            using OpenTK.Windowing.GraphicsLibraryFramework;

            public enum ContextProfile { Core }
            public enum ContextFlags { ForwardCompatible }
            public enum VSyncMode { Off, On }
            public enum WindowState { Normal, Fullscreen }
            public struct FramebufferResizeEventArgs { public int Width, Height; }
            public struct MinimizedEventArgs { public bool IsMinimized; }
            public struct FocusedChangedEventArgs { public bool IsFocused; }
            public struct FileDropEventArgs { public string[] FileNames; }
            public struct TextInputEventArgs { public string AsString; }
            public struct MouseWheelEventArgs { public float OffsetY; }
            public struct MouseButtonEventArgs { public MouseButton Button; public KeyModifiers Modifiers; }
            public struct MouseMoveEventArgs { public Vector2 Position; public float DeltaX, DeltaY; }
            public struct KeyboardKeyEventArgs
            {
                public Keys Key;
                public int ScanCode;
                public KeyModifiers Modifiers;
                public bool IsRepeat;
            }
        }

        namespace OpenTK.Windowing.Desktop
        {
            using OpenTK.Mathematics;
            using OpenTK.Windowing.Common;
            using OpenTK.Windowing.GraphicsLibraryFramework;

            public interface IGLFWGraphicsContext { bool IsCurrent { get; } void SwapBuffers(); }

            public static class GLFWProvider
            {
                public static bool CheckForMainThread { get; set; }
                public static void SetErrorCallback(GLFWCallbacks.ErrorCallback callback) { }
                public static void EnsureInitialized() { }
            }

            public class NativeWindowSettings
            {
                public string Title = "";
                public Vector2i ClientSize;
                public bool StartVisible, StartFocused;
                public Version APIVersion = new();
                public ContextProfile Profile;
                public ContextFlags Flags;
                public VSyncMode Vsync;
                public int? DepthBits, StencilBits;
            }

            public class NativeWindow(NativeWindowSettings settings) : IDisposable
            {
                public string Title = settings.Title, ClipboardString = "";
                public Vector2i ClientSize, FramebufferSize;
                public Vector2 MousePosition;
                public WindowState WindowState;
                public unsafe Window* WindowPtr => null;
                public IGLFWGraphicsContext Context => throw new();
                public event Action<System.ComponentModel.CancelEventArgs> Closing { add { } remove { } }
                public event Action Refresh { add { } remove { } }
                public event Action<FramebufferResizeEventArgs> FramebufferResize { add { } remove { } }
                public event Action<MinimizedEventArgs> Minimized { add { } remove { } }
                public event Action<FocusedChangedEventArgs> FocusedChanged { add { } remove { } }
                public event Action<FileDropEventArgs> FileDrop { add { } remove { } }
                public event Action<KeyboardKeyEventArgs> KeyDown { add { } remove { } }
                public event Action<KeyboardKeyEventArgs> KeyUp { add { } remove { } }
                public event Action<TextInputEventArgs> TextInput { add { } remove { } }
                public event Action<MouseButtonEventArgs> MouseDown { add { } remove { } }
                public event Action<MouseButtonEventArgs> MouseUp { add { } remove { } }
                public event Action<MouseMoveEventArgs> MouseMove { add { } remove { } }
                public event Action<MouseWheelEventArgs> MouseWheel { add { } remove { } }
                public void MakeCurrent() { }
                public void NewInputFrame() { }
                public static void ProcessWindowEvents(bool waitForEvents) { }
                public void Dispose() { }
            }
        }
        """;

    [Fact]
    public void FilesForNuGet_WithItsDeclarations_Compile()
    {
        using var folder = new TemporaryFolder();
        folder.Write("OpenTK.cs", Declarations);
        var runtime = Path.GetDirectoryName(typeof(object).Assembly.Location)!;
        var compiler = Directory.GetFiles(Path.Combine(runtime, "../../../sdk"), "csc.dll", SearchOption.AllDirectories).Max()!;
        string[] sources =
        [
            .. Directory.GetFiles(Repository.Full("FractalEngine.Render"), "*.NuGet.cs", SearchOption.AllDirectories),
            Repository.Full("FractalEngine.Render/Gl/State/GlShim.cs"),
        ];
        string[] references =
        [
            "System.Private.CoreLib", "System.Runtime", "System.Collections", "System.Linq", "System.ObjectModel",
            "System.ComponentModel.Primitives", "System.ComponentModel",
        ];
        // The name lets the code see what is internal. What it declares counts before what the engine has under the same name.
        var (exitCode, output, _) = Dotnet.Run(
            folder.Path, null,
            [
                compiler, "-nologo", "-noconfig", "-nostdlib", "-target:library", "-langversion:latest", "-nullable", "-unsafe",
                "-nowarn:CS0436,CS8618,CS8603,CS0649", "-out:FractalEngine.Tests.dll",
                .. references.Select(name => $"-reference:{Path.Combine(runtime, name)}.dll"),
                $"-reference:{typeof(Renderer).Assembly.Location}", $"-reference:{typeof(FractalEngineException).Assembly.Location}",
                "OpenTK.cs", .. sources,
            ]);
        Assert.Equal(2, sources.Count(static name => name.EndsWith(".NuGet.cs", StringComparison.Ordinal)));
        Assert.Equal((0, ""), (exitCode, output));
    }
}
