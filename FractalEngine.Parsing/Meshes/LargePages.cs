using System.Runtime.CompilerServices;
using System.Runtime.InteropServices;

namespace FractalEngine.Parsing.Meshes;

/// <summary>
/// Allocates large arrays whose memory comes in pages of 2 MB where the system has them: each first touch of a page costs time.
/// </summary>
internal static class LargePages
{
    private const int PageBytes = 1 << 21;

    // From <sys/mman.h> on Linux.
    private const int AdviseHugePages = 14;

    /// <summary>Allocates an array without clearing it.</summary>
    /// <param name="length">Number of elements.</param>
    public static T[] Allocate<T>(int length)
        where T : unmanaged
    {
        var array = GC.AllocateUninitializedArray<T>(length);
        if (OperatingSystem.IsLinux() && (long)length * Unsafe.SizeOf<T>() >= 2 * PageBytes)
        {
            Advise(MemoryMarshal.AsBytes(array.AsSpan()));
        }

        return array;
    }

    /// <summary>Asks for large pages in what is not touched yet. The array may move later, which costs nothing but the advantage.</summary>
    private static unsafe void Advise(Span<byte> bytes)
    {
        fixed (byte* start = bytes)
        {
            var first = ((nuint)start + PageBytes - 1) & ~(nuint)(PageBytes - 1);
            var end = ((nuint)start + (nuint)bytes.Length) & ~(nuint)(PageBytes - 1);
            if (end > first)
            {
                // Refused where the system has none: then pages are small.
                _ = AdviseMemory(first, end - first, AdviseHugePages);
            }
        }
    }

    [DllImport("libc", EntryPoint = "madvise")]
    private static extern int AdviseMemory(nuint start, nuint length, int advice);
}
