using System.Runtime.InteropServices;

namespace FractalEngine.Render.Windowing;

/// <summary>From SDL's events to ours. Numbers are those of SDL_events.h, SDL_video.h, SDL_keycode.h and SDL_scancode.h.</summary>
internal static class SdlEventTranslator
{
    private const int ScanCodeMask = 1 << 30;

    /// <summary>Our word for an event, or null for one that concerns nobody or another window.</summary>
    public static WindowEvent? Translate(in SdlEvent item, uint windowId) => item.Type switch
    {
        0x1000 when item.DropWindowId == windowId || item.DropWindowId == 0 => TranslateDrop(item.DroppedFile),
        _ when item.WindowId != windowId => null,
        0x200 => TranslateWindow(item),
        0x300 => new KeyPressed(KeyOf(item.KeyCode, item.ScanCode), ModifiersOf(item.Modifiers), item.IsRepeat != 0),
        0x301 => new KeyReleased(KeyOf(item.KeyCode, item.ScanCode), ModifiersOf(item.Modifiers)),
        0x400 => new MouseMoved(item.MotionX, item.MotionY, item.MotionDeltaX, item.MotionDeltaY),
        0x401 => new MousePressed(ButtonOf(item.Button), item.ButtonX, item.ButtonY, ModifiersOf(SdlWindow.GetModState())),
        0x402 => new MouseReleased(ButtonOf(item.Button), item.ButtonX, item.ButtonY, ModifiersOf(SdlWindow.GetModState())),
        0x403 => new WheelTurned(
            (item.WheelDirection == 1 ? -1 : 1) * item.PreciseWheelY, ModifiersOf(SdlWindow.GetModState())),
        _ => null,
    };

    /// <summary>
    /// By what the key's cap says where that is a character of ours, so that other layouts than the American one work; else by
    /// the key's place.
    /// </summary>
    public static Key KeyOf(int keyCode, int scanCode) => keyCode switch
    {
        >= 'a' and <= 'z' => Key.A + (keyCode - 'a'),
        >= '0' and <= '9' => Key.Digit0 + (keyCode - '0'),
        '+' or '=' => Key.Plus,
        '-' => Key.Minus,
        ',' => Key.Comma,
        '.' => Key.Period,
        '/' => Key.Slash,
        '[' => Key.LeftBracket,
        ']' => Key.RightBracket,
        // Keys without a character carry the scan code of their layout (arrows, F keys, the keypad).
        _ when (keyCode & ScanCodeMask) != 0 => KeyOfScanCode(keyCode & ~ScanCodeMask),
        _ => KeyOfScanCode(scanCode),
    };

    private static Key KeyOfScanCode(int scanCode) => scanCode switch
    {
        >= 4 and <= 29 => Key.A + (scanCode - 4),
        >= 30 and <= 38 => Key.Digit1 + (scanCode - 30),
        39 => Key.Digit0,
        40 => Key.Enter,
        41 => Key.Escape,
        42 => Key.Backspace,
        43 => Key.Tab,
        44 => Key.Space,
        45 => Key.Minus,
        46 => Key.Plus,
        47 => Key.LeftBracket,
        48 => Key.RightBracket,
        54 => Key.Comma,
        55 => Key.Period,
        56 => Key.Slash,
        >= 58 and <= 69 => Key.F1 + (scanCode - 58),
        73 => Key.Insert,
        74 => Key.Home,
        75 => Key.PageUp,
        76 => Key.Delete,
        77 => Key.End,
        78 => Key.PageDown,
        79 => Key.Right,
        80 => Key.Left,
        81 => Key.Down,
        82 => Key.Up,
        86 => Key.KeypadMinus,
        87 => Key.KeypadPlus,
        88 => Key.KeypadEnter,
        >= 89 and <= 97 => Key.Keypad1 + (scanCode - 89),
        98 => Key.Keypad0,
        224 => Key.LeftControl,
        225 => Key.LeftShift,
        226 => Key.LeftAlt,
        228 => Key.RightControl,
        229 => Key.RightShift,
        230 => Key.RightAlt,
        _ => Key.Unknown,
    };

    private static WindowEvent? TranslateWindow(in SdlEvent item) => item.WindowAction switch
    {
        1 or 9 => new VisibilityChanged(true),
        2 or 7 => new VisibilityChanged(false),
        3 => new WindowExposed(),
        6 => new WindowResized(item.Data1, item.Data2),
        13 => new FocusLost(),
        14 => new CloseRequested(),
        _ => null,
    };

    private static FileDropped? TranslateDrop(IntPtr file) =>
        Marshal.PtrToStringUTF8(file) is { Length: > 0 } path ? new(path) : null;

    private static MouseButton ButtonOf(byte button) => button switch
    {
        1 => MouseButton.Left,
        2 => MouseButton.Middle,
        3 => MouseButton.Right,
        _ => MouseButton.Other,
    };

    private static KeyModifiers ModifiersOf(int state) =>
        ((state & 0x3) != 0 ? KeyModifiers.Shift : 0)
        | ((state & 0xC0) != 0 ? KeyModifiers.Control : 0)
        | ((state & 0x300) != 0 ? KeyModifiers.Alt : 0);
}
