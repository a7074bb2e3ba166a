using System.Runtime.InteropServices;

namespace FractalEngine.Render.Images;

/// <summary>The beginning of SDL_Surface (SDL_surface.h).</summary>
[StructLayout(LayoutKind.Sequential)]
internal readonly struct SdlSurface
{
    public readonly uint Flags;
    public readonly IntPtr Format;
    public readonly int Width;
    public readonly int Height;
    public readonly int Pitch;
    public readonly IntPtr Pixels;
}
