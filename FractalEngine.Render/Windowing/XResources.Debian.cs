using System.Globalization;
using System.Runtime.InteropServices;

namespace FractalEngine.Render.Windowing;

/// <summary>Reads what the user's desktop has set for all programs on the X display.</summary>
internal static partial class XResources
{
    private const double UnscaledDotsPerInch = 96;
    private const string Library = "libX11";

    /// <summary>Returns how large the desktop wants texts, by the resource Xft.dpi: 1 where it says nothing, and within 1 and 4.</summary>
    public static double ReadContentScale()
    {
        var display = OpenDisplay(null);
        if (display == IntPtr.Zero)
        {
            return 1;
        }

        var text = Marshal.PtrToStringUTF8(GetDefault(display, "Xft", "dpi"));
        _ = CloseDisplay(display);
        return double.TryParse(text, CultureInfo.InvariantCulture, out var dotsPerInch) && dotsPerInch > UnscaledDotsPerInch
            ? Math.Min(dotsPerInch / UnscaledDotsPerInch, 4)
            : 1;
    }

    [LibraryImport(Library, EntryPoint = "XOpenDisplay", StringMarshalling = StringMarshalling.Utf8)]
    private static partial IntPtr OpenDisplay(string? name);

    [LibraryImport(Library, EntryPoint = "XCloseDisplay")]
    private static partial int CloseDisplay(IntPtr display);

    [LibraryImport(Library, EntryPoint = "XGetDefault", StringMarshalling = StringMarshalling.Utf8)]
    private static partial IntPtr GetDefault(IntPtr display, string program, string option);
}
