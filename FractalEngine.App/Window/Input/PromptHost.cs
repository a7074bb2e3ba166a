using FractalEngine.Render.Windowing.Events;
using FractalEngine.Render.Windowing.Keyboard;

namespace FractalEngine.App.Window.Input;

/// <summary>Holds the question that is open, and passes keys and text to it instead of to the scene.</summary>
/// <param name="readClipboard">Returns the text of the clipboard, which Ctrl+V enters.</param>
internal sealed class PromptHost(Func<string> readClipboard)
{
    private bool _ignoresText;

    /// <summary>The open question; null for none.</summary>
    public Prompt? Current { get; private set; }

    /// <summary>Opens a question in place of the one before.</summary>
    public void Open(Prompt prompt) => Current = prompt;

    /// <summary>Passes an event to the open question.</summary>
    /// <returns>True for a key or text that the scene must not see.</returns>
    public bool Handle(WindowEvent windowEvent)
    {
        switch (windowEvent)
        {
            case KeyPressed pressed:
                return HandleKey(pressed);
            case TextEntered entered when Current is { } prompt:
                if (!_ignoresText)
                {
                    prompt.HandleText(entered.Text);
                }

                return true;
            default:
                return windowEvent is TextEntered;
        }
    }

    /// <summary>Passes a click on a line of the open question, which answers something.</summary>
    public void Answer(int answer)
    {
        if (Current is { } prompt)
        {
            prompt.HandleAnswer(answer);
            ForgetIfAnswered(prompt);
        }
    }

    /// <summary>Tells that a key which this class did not take has been handled, and may have opened a question.</summary>
    public void KeyHandled() => _ignoresText = Current is not null;

    /// <summary>Lets go of a question that was answered, unless the answer has opened another one.</summary>
    private void ForgetIfAnswered(Prompt prompt)
    {
        if (prompt.IsClosed && Current == prompt)
        {
            Current = null;
        }
    }

    private bool HandleKey(KeyPressed pressed)
    {
        // A screenshot of the scene changes nothing that is asked about.
        if (Current is not { } prompt || pressed.Key == Key.F12)
        {
            return false;
        }

        _ignoresText = false;
        if (pressed.Key == Key.V && pressed.Modifiers.HasFlag(KeyModifiers.Control))
        {
            prompt.HandleText(readClipboard());
            return true;
        }

        prompt.HandleKey(pressed);
        ForgetIfAnswered(prompt);
        // The text of a key follows the key. It does not belong to a question that the key has opened.
        _ignoresText = Current is not null && Current != prompt;
        return true;
    }
}
