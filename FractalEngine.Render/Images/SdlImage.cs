using System.Runtime.InteropServices;

namespace FractalEngine.Render.Images;

/// <summary>The functions of SDL 2 and SDL2_image that read and write pictures.</summary>
internal static partial class SdlImage
{
    /// <summary>
    /// SDL's format whose bytes are red, green, blue, alpha in memory on little-endian machines (SDL_PIXELFORMAT_ABGR8888).
    /// </summary>
    public const uint RgbaFormat = 0x16762004;

    [LibraryImport("SDL2", EntryPoint = "SDL_CreateRGBSurfaceWithFormatFrom")]
    public static partial IntPtr CreateSurfaceFrom(IntPtr pixels, int width, int height, int depth, int pitch, uint format);

    [LibraryImport("SDL2", EntryPoint = "SDL_ConvertSurfaceFormat")]
    public static partial IntPtr ConvertSurface(IntPtr surface, uint format, uint flags);

    [LibraryImport("SDL2", EntryPoint = "SDL_FreeSurface")]
    public static partial void FreeSurface(IntPtr surface);

    [LibraryImport("SDL2_image", EntryPoint = "IMG_SavePNG", StringMarshalling = StringMarshalling.Utf8)]
    public static partial int SavePng(IntPtr surface, string path);

    [LibraryImport("SDL2_image", EntryPoint = "IMG_Load", StringMarshalling = StringMarshalling.Utf8)]
    public static partial IntPtr Load(string path);

    /// <summary>The last error, in SDL's words.</summary>
    public static string ErrorText() => Marshal.PtrToStringUTF8(GetError()) is { Length: > 0 } text ? text : "no reason given";

    [LibraryImport("SDL2", EntryPoint = "SDL_GetError")]
    private static partial IntPtr GetError();
}
