using System.Collections.Immutable;
using FractalEngine.Render.Ui.Overlays;
using FractalEngine.Render.Windowing.Events;
using FractalEngine.Render.Windowing.Keyboard;

namespace FractalEngine.App.Window.Input;

/// <summary>A question that is answered by one key. Escape only closes it.</summary>
/// <param name="title">The question.</param>
/// <param name="details">Lines below the question.</param>
/// <param name="choices">The answers.</param>
internal sealed class ChoicePrompt(string title, IEnumerable<string> details, params ImmutableArray<PromptChoice> choices) : Prompt
{
    public override OverlayPanel Panel { get; } = new(OverlayAnchor.Centre,
    [
        .. details.Select(static line => new OverlayLine(line)),
        .. choices.Select(static (choice, index) => new OverlayLine(choice.Key.ToString(), choice.Text) { Answer = index }),
        new OverlayLine("Esc", "cancel") { Answer = choices.Length },
    ])
    {
        Title = title,
        IsQuestion = true,
    };

    public override void HandleKey(KeyPressed pressed)
    {
        if (pressed.IsRepeat)
        {
            return;
        }

        if (pressed.Key == Key.Escape)
        {
            Close();
        }
        else if (choices.FirstOrDefault(choice => choice.Key == pressed.Key) is { } chosen)
        {
            Choose(chosen);
        }
    }

    public override void HandleAnswer(int answer)
    {
        if (answer == choices.Length)
        {
            Close();
        }
        else
        {
            Choose(choices[answer]);
        }
    }

    private void Choose(PromptChoice choice)
    {
        Close();
        choice.Run?.Invoke();
    }
}

/// <summary>One answer of a <see cref="ChoicePrompt"/>.</summary>
/// <param name="Key">The key that gives the answer.</param>
/// <param name="Text">What the answer does, for the user.</param>
/// <param name="Run">Runs the answer; null for an answer that only closes the question.</param>
internal sealed record PromptChoice(Key Key, string Text, Action? Run);
