using System.Runtime.InteropServices;
using FractalEngine.Core.Images;

namespace FractalEngine.Render.Images;

/// <summary>Reads images with SDL2_image.</summary>
internal static partial class SdlImage
{
    // The bytes are red, green, blue, alpha in memory on little-endian machines (SDL_PIXELFORMAT_ABGR8888).
    private const uint RgbaFormat = 0x16762004;

    /// <summary>Reads a file of any format that the library knows.</summary>
    /// <exception cref="IOException">The file can't be read; the message is the library's.</exception>
    /// <exception cref="DllNotFoundException">SDL 2 or SDL2_image is missing.</exception>
    public static PixelImage Read(string path)
    {
        var loaded = Load(path);
        if (loaded == IntPtr.Zero)
        {
            throw new IOException(ErrorText());
        }

        var surface = ConvertSurface(loaded, RgbaFormat, 0);
        FreeSurface(loaded);
        if (surface == IntPtr.Zero)
        {
            throw new IOException(ErrorText());
        }

        try
        {
            return Copy(surface);
        }
        finally
        {
            FreeSurface(surface);
        }
    }

    private static unsafe PixelImage Copy(IntPtr surface)
    {
        ref readonly var header = ref *(SdlSurface*)surface;
        var pixels = new byte[4 * header.Width * header.Height];
        for (var y = 0; y < header.Height; y++)
        {
            Marshal.Copy(header.Pixels + (y * header.Pitch), pixels, 4 * header.Width * y, 4 * header.Width);
        }

        return new(header.Width, header.Height, pixels);
    }

    private static string ErrorText() => Marshal.PtrToStringUTF8(GetError()) is { Length: > 0 } text ? text : "no reason given";

    [LibraryImport("SDL2", EntryPoint = "SDL_ConvertSurfaceFormat")]
    private static partial IntPtr ConvertSurface(IntPtr surface, uint format, uint flags);

    [LibraryImport("SDL2", EntryPoint = "SDL_FreeSurface")]
    private static partial void FreeSurface(IntPtr surface);

    [LibraryImport("SDL2_image", EntryPoint = "IMG_Load", StringMarshalling = StringMarshalling.Utf8)]
    private static partial IntPtr Load(string path);

    [LibraryImport("SDL2", EntryPoint = "SDL_GetError")]
    private static partial IntPtr GetError();
}
