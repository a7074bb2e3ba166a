using System.Collections.Immutable;
using FractalEngine.Render.Ui.Overlays;
using FractalEngine.Render.Ui.Widgets;
using FractalEngine.Render.Windowing.Events;
using FractalEngine.Render.Windowing.Keyboard;

namespace FractalEngine.App.Window.Input;

/// <summary>
/// A line of text that the user edits, with suggestions. Tab completes, Up and Down pick a suggestion, Enter accepts, Escape cancels.
/// </summary>
/// <param name="title">What is asked for.</param>
/// <param name="text">The text to begin with.</param>
/// <param name="accept">Takes the text. Returns why it is refused, or null to close the question.</param>
/// <param name="suggest">Returns the texts that a beginning could become; null for none.</param>
internal sealed class TextPrompt(
    string title, string text, Func<string, string?> accept, Func<string, ImmutableArray<string>>? suggest = null) : Prompt
{
    private const int MaxShownSuggestions = 8;

    private UiTextEdit _edit = new(text);
    private ImmutableArray<string>? _suggestions;
    private int? _picked;
    private string? _refusal;

    /// <summary>The text as it is edited so far.</summary>
    public string Text => _edit.Text;

    public override OverlayPanel Panel
    {
        get
        {
            var first = Math.Clamp((_picked ?? 0) - (MaxShownSuggestions / 2), 0, Math.Max(0, Suggestions.Length - MaxShownSuggestions));
            var shown = Suggestions.Select((suggestion, index) => new OverlayLine(
                (index == _picked ? "> " : "  ") + suggestion, null, index == _picked ? OverlayTone.Accent : OverlayTone.Dim)
            {
                Answer = index,
            });
            var hiddenCount = Suggestions.Length - MaxShownSuggestions;
            return new(OverlayAnchor.Centre,
            [
                new OverlayLine($"{Text[.._edit.Caret]}|{Text[_edit.Caret..]}"),
                .. shown.Skip(first).Take(MaxShownSuggestions),
                .. hiddenCount > 0 ? [new OverlayLine($"  … {hiddenCount} more", null, OverlayTone.Dim)] : (OverlayLine[])[],
                .. _refusal is { } refusal ? [new OverlayLine(refusal, null, OverlayTone.Warning)] : (OverlayLine[])[],
                new OverlayLine($"{(suggest is null ? "" : "Tab completes, ")}Enter accepts, Esc cancels", null, OverlayTone.Dim),
            ])
            {
                Title = title,
                IsQuestion = true,
            };
        }
    }

    private ImmutableArray<string> Suggestions => _suggestions ??= suggest?.Invoke(Text) ?? [];

    public override void HandleText(string text) => Edit(() => _edit.Insert(text));

    public override void HandleKey(KeyPressed pressed)
    {
        switch (pressed.Key)
        {
            case Key.Escape:
                Close();
                break;
            case Key.Enter or Key.KeypadEnter:
                Accept();
                break;
            case Key.Tab:
                Complete();
                break;
            case Key.Up:
                Pick(-1);
                break;
            case Key.Down:
                Pick(1);
                break;
            default:
                // Ctrl+U is the only chord: nothing is selected that others would copy.
                var isChord = pressed.Key == Key.U && pressed.Modifiers.HasFlag(KeyModifiers.Control);
                Edit(() => _edit.Handle(pressed.Key, selects: false, isChord));
                break;
        }
    }

    public override void HandleAnswer(int answer)
    {
        _picked = answer;
        Accept();
    }

    private void Accept()
    {
        if (_picked is { } picked)
        {
            Replace(Suggestions[picked]);
        }

        _refusal = accept(Text);
        if (_refusal is null)
        {
            Close();
        }
    }

    /// <summary>Takes the picked suggestion, or extends the text as far as all suggestions agree.</summary>
    private void Complete()
    {
        if (Suggestions.Length == 0)
        {
            return;
        }

        var completed = _picked is { } picked ? Suggestions[picked] : Suggestions.Skip(1).Aggregate(Suggestions[0], CommonBeginning);
        if (completed.Length > Text.Length || _picked is not null)
        {
            Replace(completed);
        }
    }

    private void Pick(int step)
    {
        if (Suggestions.Length > 0)
        {
            _picked = _picked is { } picked ? Math.Clamp(picked + step, 0, Suggestions.Length - 1) : step > 0 ? 0 : Suggestions.Length - 1;
        }
    }

    private void Replace(string text)
    {
        _edit = new(text);
        Forget();
    }

    private void Edit(Action change)
    {
        var before = Text;
        change();
        // Nothing shows a selection here, so that there is none.
        _edit.MoveTo(_edit.Caret, selects: false);
        if (Text != before)
        {
            Forget();
        }
    }

    /// <summary>Lets go of what belonged to another text.</summary>
    private void Forget()
    {
        _suggestions = null;
        _picked = null;
        _refusal = null;
    }

    private static string CommonBeginning(string text1, string text2)
    {
        var length = text1.Zip(text2).TakeWhile(static pair => pair.First == pair.Second).Count();
        return text1[..length];
    }
}
