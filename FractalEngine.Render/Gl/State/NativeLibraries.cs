using System.Reflection;
using System.Runtime.CompilerServices;
using System.Runtime.InteropServices;

namespace FractalEngine.Render.Gl.State;

/// <summary>
/// Finds native libraries under the names of each system. Debian's OpenTK uses the Windows names and relies on Mono's <c>dllmap</c>, which
/// .NET does not read. The engine's own imports are named <c>SDL2</c>.
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

    /// <summary>Returns the file name of an imported library on Linux; null where the loader's own search finds it.</summary>
    private static string? LinuxName(string name) => name switch
    {
        "opengl32.dll" => "libGL.so.1",
        "SDL2" or "SDL2.dll" => "libSDL2-2.0.so.0",
        "libX11" => "libX11.so.6",
        "libXi" => "libXi.so.6",
        "libXcursor.so.1" => "libXcursor.so.1",
        "libXinerama" => "libXinerama.so.1",
        "libXrandr.so.2" => "libXrandr.so.2",
        "libXxf86vm" => "libXxf86vm.so.1",
        "libEGL.dll" => "libEGL.so.1",
        "dl" => "libdl.so.2",
        _ => null,
    };

    // Where there is no handle, the loader searches by its own rules, and throws DllNotFoundException if it finds nothing.
    private static IntPtr Resolve(string name, Assembly assembly, DllImportSearchPath? searchPath) =>
        OperatingSystem.IsLinux() && LinuxName(name) is { } file && NativeLibrary.TryLoad(file, out var handle) ? handle : IntPtr.Zero;
}
