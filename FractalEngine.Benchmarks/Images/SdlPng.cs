using System.Runtime.InteropServices;
using System.Text;
using FractalEngine.Core.Images;

namespace FractalEngine.Benchmarks.Images;

/// <summary>Reads and writes PNG files with SDL2_image, whose libraries have their Linux names here.</summary>
internal static class SdlPng
{
    private const string Sdl = "libSDL2-2.0.so.0";
    private const string SdlImage = "libSDL2_image-2.0.so.0";

    // SDL_PIXELFORMAT_ABGR8888: red, green, blue, alpha in memory.
    private const uint Rgba = 0x16762004;

    /// <summary>Decodes a file and discards the pixels.</summary>
    public static void Load(string path)
    {
        var surface = LoadSurface(ToUtf8(path));
        ThrowIf(surface == IntPtr.Zero, path);
        FreeSurface(surface);
    }

    /// <summary>Writes an image to a file.</summary>
    public static void Save(PixelImage image, string path)
    {
        var pixels = GCHandle.Alloc(image.Pixels, GCHandleType.Pinned);
        try
        {
            var surface = CreateSurface(pixels.AddrOfPinnedObject(), image.Width, image.Height, 32, 4 * image.Width, Rgba);
            ThrowIf(surface == IntPtr.Zero, path);
            var result = SavePng(surface, ToUtf8(path));
            FreeSurface(surface);
            ThrowIf(result != 0, path);
        }
        finally
        {
            pixels.Free();
        }
    }

    private static byte[] ToUtf8(string path) => [.. Encoding.UTF8.GetBytes(path), 0];

    private static void ThrowIf(bool hasFailed, string path)
    {
        if (hasFailed)
        {
            throw new IOException($"SDL2_image fails on {path}");
        }
    }

    [DllImport(SdlImage, EntryPoint = "IMG_Load")]
    private static extern IntPtr LoadSurface(byte[] path);

    [DllImport(SdlImage, EntryPoint = "IMG_SavePNG")]
    private static extern int SavePng(IntPtr surface, byte[] path);

    [DllImport(Sdl, EntryPoint = "SDL_CreateRGBSurfaceWithFormatFrom")]
    private static extern IntPtr CreateSurface(IntPtr pixels, int width, int height, int depth, int pitch, uint format);

    [DllImport(Sdl, EntryPoint = "SDL_FreeSurface")]
    private static extern void FreeSurface(IntPtr surface);
}
