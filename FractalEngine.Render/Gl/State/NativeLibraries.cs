using System.Reflection;
using System.Runtime.CompilerServices;
using System.Runtime.InteropServices;

namespace FractalEngine.Render.Gl.State;

/// <summary>
/// Finds native libraries under the names of each system. Debian's OpenTK uses the Windows names and relies on Mono's <c>dllmap</c>, which
/// .NET does not read. The engine's own imports are named <c>SDL2</c> and <c>SDL2_image</c> on every system.
/// </summary>
internal static class NativeLibraries
{
    // A module initialiser runs before the first import of either assembly, in every program that uses this one.
#pragma warning disable CA2255
    [ModuleInitializer]
#pragma warning restore CA2255
    internal static void Register()
    {
        NativeLibrary.SetDllImportResolver(typeof(NativeLibraries).Assembly, Resolve);
#if OPENTK_DEBIAN
        NativeLibrary.SetDllImportResolver(typeof(OpenTK.NativeWindow).Assembly, Resolve);
#endif
    }

    /// <summary>Returns the file names of an imported library; none where the loader's own search finds it.</summary>
    internal static IReadOnlyList<string> Candidates(string name) =>
        OperatingSystem.IsLinux() ? LinuxNames(name)
        : OperatingSystem.IsMacOS() ? MacNames(name)
        : [];

    private static IReadOnlyList<string> LinuxNames(string name) => name switch
    {
        "opengl32.dll" => ["libGL.so.1"],
        "SDL2" or "SDL2.dll" => ["libSDL2-2.0.so.0"],
        "SDL2_image" => ["libSDL2_image-2.0.so.0"],
        "libX11" => ["libX11.so.6"],
        "libXi" => ["libXi.so.6"],
        "libXcursor.so.1" => ["libXcursor.so.1"],
        "libXinerama" => ["libXinerama.so.1"],
        "libXrandr.so.2" => ["libXrandr.so.2"],
        "libXxf86vm" => ["libXxf86vm.so.1"],
        "libEGL.dll" => ["libEGL.so.1"],
        "dl" => ["libdl.so.2"],
        _ => [],
    };

    private static IReadOnlyList<string> MacNames(string name) => name switch
    {
        "SDL2" => ["libSDL2.dylib", "/opt/homebrew/lib/libSDL2.dylib", "/usr/local/lib/libSDL2.dylib"],
        "SDL2_image" =>
            ["libSDL2_image.dylib", "/opt/homebrew/lib/libSDL2_image.dylib", "/usr/local/lib/libSDL2_image.dylib"],
        _ => [],
    };

    private static IntPtr Resolve(string name, Assembly assembly, DllImportSearchPath? searchPath)
    {
        foreach (var candidate in Candidates(name))
        {
            if (NativeLibrary.TryLoad(candidate, out var handle))
            {
                return handle;
            }
        }

        // The loader then searches by its own rules, and throws DllNotFoundException if it finds nothing.
        return IntPtr.Zero;
    }
}
