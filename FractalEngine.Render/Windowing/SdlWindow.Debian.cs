using System.Runtime.InteropServices;

namespace FractalEngine.Render.Windowing;

/// <summary>Imports functions of SDL 2 that OpenTK 1.1 does not offer: waiting, waking, raw events, the relative mouse.</summary>
internal static unsafe partial class SdlWindow
{
    public const uint InitVideo = 0x20;
    public const uint UserEvent = 0x8000;
    private const string Library = "SDL2";

    [LibraryImport(Library, EntryPoint = "SDL_SetHint", StringMarshalling = StringMarshalling.Utf8)]
    public static partial int SetHint(string name, string value);

    [LibraryImport(Library, EntryPoint = "SDL_InitSubSystem")]
    public static partial int InitSubSystem(uint flags);

    [LibraryImport(Library, EntryPoint = "SDL_GetError")]
    public static partial IntPtr GetError();

    [LibraryImport(Library, EntryPoint = "SDL_WaitEventTimeout")]
    public static partial int WaitEventTimeout(IntPtr noEvent, int milliseconds);

    [LibraryImport(Library, EntryPoint = "SDL_FlushEvents")]
    public static partial void FlushEvents(uint first, uint last);

    [LibraryImport(Library, EntryPoint = "SDL_PushEvent")]
    public static partial int PushEvent(SdlEvent* item);

    [LibraryImport(Library, EntryPoint = "SDL_AddEventWatch")]
    public static partial void AddEventWatch(delegate* unmanaged[Cdecl]<IntPtr, SdlEvent*, int> watch, IntPtr data);

    [LibraryImport(Library, EntryPoint = "SDL_DelEventWatch")]
    public static partial void DeleteEventWatch(delegate* unmanaged[Cdecl]<IntPtr, SdlEvent*, int> watch, IntPtr data);

    [LibraryImport(Library, EntryPoint = "SDL_GetWindowID")]
    public static partial uint GetWindowId(IntPtr window);

    [LibraryImport(Library, EntryPoint = "SDL_GetModState")]
    public static partial ushort GetModState();

    [LibraryImport(Library, EntryPoint = "SDL_SetClipboardText", StringMarshalling = StringMarshalling.Utf8)]
    public static partial int SetClipboardText(string text);

    [LibraryImport(Library, EntryPoint = "SDL_GetClipboardText")]
    private static partial IntPtr GetClipboardText();

    [LibraryImport(Library, EntryPoint = "SDL_free")]
    private static partial void Free(IntPtr memory);

    /// <summary>Returns the text of the clipboard, empty where it holds none.</summary>
    public static string ReadClipboard()
    {
        var text = GetClipboardText();
        try
        {
            return Marshal.PtrToStringUTF8(text) ?? "";
        }
        finally
        {
            Free(text);
        }
    }

    /// <summary>Returns the last error of this thread, in SDL's words.</summary>
    public static string ErrorText() => Marshal.PtrToStringUTF8(GetError()) is { Length: > 0 } text ? text : "no reason given";
}
