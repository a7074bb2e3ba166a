using FractalEngine.Render.Windowing.Events;
using FractalEngine.Render.Windowing.Keyboard;

namespace FractalEngine.App.Window.Input;

/// <summary>
/// Tells keys that edit the composition of an input method from those that edit a text field. Windowing systems pass both on alike, but a
/// letter that becomes part of a composition is not followed by its text.
/// </summary>
internal sealed class TextComposition
{
    private int _letterCount;

    /// <summary>Notes an event, and tells whether it is a key that only the input method must see.</summary>
    /// <param name="windowEvent">Any event of the window.</param>
    /// <param name="isEditing">Whether a question or a widget takes keys and text.</param>
    public bool Takes(WindowEvent windowEvent, bool isEditing)
    {
        if (!isEditing || windowEvent is TextEntered or MousePressed or FocusLost)
        {
            _letterCount = 0;
        }
        else if (windowEvent is KeyPressed { Key: var key, Modifiers: KeyModifiers.None or KeyModifiers.Shift })
        {
            if (key is >= Key.A and <= Key.Z)
            {
                _letterCount++;
            }
            else if (_letterCount > 0 && key is (>= Key.Left and <= Key.Tab and not Key.Space) or Key.KeypadEnter)
            {
                _letterCount = key is Key.Enter or Key.KeypadEnter or Key.Escape ? 0
                    : key == Key.Backspace ? _letterCount - 1 : _letterCount;
                return true;
            }
        }

        return false;
    }
}
