using System.Runtime.InteropServices;

namespace FractalEngine.Tests.App.Window;

/// <summary>Reads one pixel of what an X server shows, whichever program has drawn it.</summary>
internal sealed class ScreenPixel : IDisposable
{
    private const nuint AllPlanes = uint.MaxValue;
    private const int ZPixmap = 2;

    private readonly nint _display = XOpenDisplay(0);

    /// <summary>Whether there is a server to ask.</summary>
    public bool IsAvailable => _display != 0;

    /// <summary>Returns the largest of red, green and blue of a pixel, from 0 to 255.</summary>
    public int Brightness(int x, int y)
    {
        var image = XGetImage(_display, XDefaultRootWindow(_display), x, y, 1, 1, AllPlanes, ZPixmap);
        var colour = (uint)XGetPixel(image, 0, 0);
        _ = XDestroyImage(image);
        return (int)Math.Max(colour & 255, Math.Max((colour >> 8) & 255, (colour >> 16) & 255));
    }

    /// <inheritdoc/>
    public void Dispose()
    {
        if (IsAvailable)
        {
            _ = XCloseDisplay(_display);
        }
    }

    [DllImport("libX11.so.6")]
    [DefaultDllImportSearchPaths(DllImportSearchPath.SafeDirectories)]
    private static extern nint XOpenDisplay(nint name);

    [DllImport("libX11.so.6")]
    [DefaultDllImportSearchPaths(DllImportSearchPath.SafeDirectories)]
    private static extern int XCloseDisplay(nint display);

    [DllImport("libX11.so.6")]
    [DefaultDllImportSearchPaths(DllImportSearchPath.SafeDirectories)]
    private static extern nint XDefaultRootWindow(nint display);

    [DllImport("libX11.so.6")]
    [DefaultDllImportSearchPaths(DllImportSearchPath.SafeDirectories)]
    private static extern nint XGetImage(nint display, nint drawable, int x, int y, uint width, uint height, nuint planes, int format);

    [DllImport("libX11.so.6")]
    [DefaultDllImportSearchPaths(DllImportSearchPath.SafeDirectories)]
    private static extern nuint XGetPixel(nint image, int x, int y);

    [DllImport("libX11.so.6")]
    [DefaultDllImportSearchPaths(DllImportSearchPath.SafeDirectories)]
    private static extern int XDestroyImage(nint image);
}
