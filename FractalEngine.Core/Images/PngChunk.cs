namespace FractalEngine.Core.Images;

/// <summary>
/// The signature and the types of chunks (PNG, third edition, §5). A type is its four letters, the first one highest.
/// </summary>
internal static class PngChunk
{
    public const uint Header = 0x49484452;
    public const uint Transparency = 0x74524E53;
    public const uint Data = 0x49444154;
    public const uint End = 0x49454E44;
    public const uint AnimationControl = 0x6163544C;
    public const uint FrameControl = 0x6663544C;
    public const uint FrameData = 0x66644154;

    /// <summary>The first eight bytes of every PNG file.</summary>
    public static ReadOnlySpan<byte> Signature => [0x89, (byte)'P', (byte)'N', (byte)'G', 0x0D, 0x0A, 0x1A, 0x0A];

    /// <summary>Whether pixels depend on a chunk: those of which every reader must know the type, and transparency.</summary>
    public static bool MakesPixels(uint type) => (type & 0x20000000) == 0 || type == Transparency;
}
