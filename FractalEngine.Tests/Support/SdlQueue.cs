using System.Runtime.InteropServices;
using System.Text;
using FractalEngine.Render.Windowing;

namespace FractalEngine.Tests.Support;

/// <summary>Queues events of SDL in the process of the tests, as the window system would. GLFW has no way to queue any.</summary>
internal static class SdlQueue
{
    // Windows are numbered from the first of the process.
    private const uint MaxWindows = 1000;

    /// <summary>Drops a file on whichever window there is. Skips the test where windows are not those of SDL.</summary>
    public static void Drop(string path)
    {
        SkipElsewhere();
        // SDL_DropEvent: its type, then the text at offset 8, then the window, 0 for any.
        var item = new byte[128];
        BitConverter.TryWriteBytes(item, 0x1000);
        BitConverter.TryWriteBytes(item.AsSpan(8), (long)DuplicateText(Encoding.UTF8.GetBytes(path + '\0')));
        Assert.Equal(1, PushEvent(item));
    }

    /// <summary>Closes whichever windows there are, by the buttons in their titles.</summary>
    public static void Close()
    {
        // SDL_WindowEvent: its type, the window at offset 8, and what happens to it.
        var item = new byte[128];
        BitConverter.TryWriteBytes(item, 0x200);
        item[12] = 14;
        for (var window = 1u; window <= MaxWindows; window++)
        {
            BitConverter.TryWriteBytes(item.AsSpan(8), window);
            Assert.Equal(1, PushEvent(item));
        }
    }

    /// <summary>Skips the test where windows are not those of SDL.</summary>
    public static void SkipElsewhere() => Elsewhere.SkipIf(
        !typeof(RenderWindow).Assembly.GetReferencedAssemblies().Any(static name => name is { Name: "OpenTK", Version.Major: 1 }),
        "the window is not one of SDL");

    [DllImport("libSDL2-2.0.so.0", EntryPoint = "SDL_PushEvent")]
    [DefaultDllImportSearchPaths(DllImportSearchPath.SafeDirectories)]
    private static extern int PushEvent(byte[] item);

    [DllImport("libSDL2-2.0.so.0", EntryPoint = "SDL_strdup")]
    [DefaultDllImportSearchPaths(DllImportSearchPath.SafeDirectories)]
    private static extern IntPtr DuplicateText(byte[] text);
}
