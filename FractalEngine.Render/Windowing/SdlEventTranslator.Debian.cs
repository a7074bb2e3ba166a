using System.Runtime.InteropServices;
using FractalEngine.Render.Windowing.Events;
using FractalEngine.Render.Windowing.Keyboard;

namespace FractalEngine.Render.Windowing;

/// <summary>Translates SDL's events. Numbers are those of SDL_events.h, SDL_video.h, SDL_keycode.h and SDL_scancode.h.</summary>
internal static class SdlEventTranslator
{
    // Types of events.
    private const uint WindowChange = 0x200;
    private const uint KeyDown = 0x300;
    private const uint KeyUp = 0x301;
    private const uint TextInput = 0x303;
    private const uint MouseMotion = 0x400;
    private const uint MouseButtonDown = 0x401;
    private const uint MouseButtonUp = 0x402;
    private const uint MouseWheel = 0x403;
    private const uint DropFile = 0x1000;

    // Direction of a wheel that counts towards the user.
    private const uint FlippedWheel = 1;

    // Marks key codes that are scan codes of the layout.
    private const int ScanCodeMask = 1 << 30;

    /// <summary>Translates an event; null for one that has no counterpart or concerns another window.</summary>
    public static WindowEvent? Translate(in SdlEvent item, uint windowId) => item.Type switch
    {
        DropFile when item.DropWindowId == windowId || item.DropWindowId == 0 => TranslateDrop(item.DroppedFile),
        _ when item.WindowId != windowId => null,
        WindowChange => TranslateWindow(item),
        KeyDown => new KeyPressed(KeyOf(item.KeyCode, item.ScanCode), ModifiersOf(item.Modifiers), item.IsRepeat != 0),
        KeyUp => new KeyReleased(KeyOf(item.KeyCode, item.ScanCode), ModifiersOf(item.Modifiers)),
        TextInput => TranslateText(item),
        MouseMotion => new MouseMoved(item.MotionX, item.MotionY, item.MotionDeltaX, item.MotionDeltaY),
        MouseButtonDown => new MousePressed(ButtonOf(item.Button), item.ButtonX, item.ButtonY, CurrentModifiers),
        MouseButtonUp => new MouseReleased(ButtonOf(item.Button), item.ButtonX, item.ButtonY, CurrentModifiers),
        MouseWheel => new WheelTurned((item.WheelDirection == FlippedWheel ? -1 : 1) * item.PreciseWheelY, CurrentModifiers),
        _ => null,
    };

    /// <summary>
    /// Translates a key by the character on its cap where that has a name in <see cref="Key"/>, otherwise by its position.
    /// </summary>
    public static Key KeyOf(int keyCode, int scanCode)
    {
        var key = KeyCharacters.KeyOf(keyCode);
        // Keys without a character (arrows, F keys, the keypad) carry the scan code of their layout.
        return key != Key.Unknown ? key
            : KeyOfScanCode((keyCode & ScanCodeMask) != 0 ? keyCode & ~ScanCodeMask : scanCode);
    }

    private static KeyModifiers CurrentModifiers => ModifiersOf(SdlWindow.GetModState());

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
        1 or 9 => new VisibilityChanged(true), // shown, restored
        2 or 7 => new VisibilityChanged(false), // hidden, minimised
        3 => new WindowExposed(),
        6 => new WindowResized(item.Data1, item.Data2),
        13 => new FocusLost(),
        14 => new CloseRequested(),
        _ => null,
    };

    private static unsafe TextEntered? TranslateText(in SdlEvent item)
    {
        fixed (SdlEvent* address = &item)
        {
            return Marshal.PtrToStringUTF8((IntPtr)address + SdlEvent.TextOffset) is { Length: > 0 } text ? new(text) : null;
        }
    }

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
