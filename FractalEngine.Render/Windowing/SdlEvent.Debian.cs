using System.Runtime.InteropServices;

namespace FractalEngine.Render.Windowing;

/// <summary>SDL's event union, with the fields that are read here at their offsets in bytes (SDL_events.h, SDL 2.0.18 and later).</summary>
[StructLayout(LayoutKind.Explicit, Size = 128)]
internal struct SdlEvent
{
    // SDL_TextInputEvent: 32 bytes of UTF-8 that end with 0
    public const int TextOffset = 12;

    [FieldOffset(0)] public uint Type;
    [FieldOffset(8)] public uint WindowId;

    // SDL_WindowEvent
    [FieldOffset(12)] public byte WindowAction;
    [FieldOffset(16)] public int Data1;
    [FieldOffset(20)] public int Data2;

    // SDL_KeyboardEvent
    [FieldOffset(13)] public byte IsRepeat;
    [FieldOffset(16)] public int ScanCode;
    [FieldOffset(20)] public int KeyCode;
    [FieldOffset(24)] public ushort Modifiers;

    // SDL_MouseButtonEvent
    [FieldOffset(16)] public byte Button;
    [FieldOffset(20)] public int ButtonX;
    [FieldOffset(24)] public int ButtonY;

    // SDL_MouseMotionEvent
    [FieldOffset(20)] public int MotionX;
    [FieldOffset(24)] public int MotionY;
    [FieldOffset(28)] public int MotionDeltaX;
    [FieldOffset(32)] public int MotionDeltaY;

    // SDL_MouseWheelEvent
    [FieldOffset(24)] public uint WheelDirection;
    [FieldOffset(32)] public float PreciseWheelY;

    // SDL_DropEvent: its window id is at another offset than in the other events
    [FieldOffset(8)] public IntPtr DroppedFile;
    [FieldOffset(16)] public uint DropWindowId;
}
