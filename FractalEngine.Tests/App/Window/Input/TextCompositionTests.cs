using FractalEngine.App.Window.Input;
using FractalEngine.Render.Windowing.Events;
using FractalEngine.Render.Windowing.Keyboard;

namespace FractalEngine.Tests.App.Window.Input;

/// <summary>Which keys reach a text field, as an input method passes them on: a letter of a composition has no text of its own.</summary>
public class TextCompositionTests
{
    private readonly TextComposition _composition = new();

    [Fact]
    public void Keys_AfterTypedText_ReachTheField()
    {
        Assert.False(Press(Key.A));
        Assert.False(Enter("a"));
        foreach (var key in new[] { Key.Backspace, Key.Left, Key.Enter, Key.Escape, Key.Tab, Key.Space, Key.Digit1, Key.F12 })
        {
            Assert.False(Press(key), key.ToString());
        }
    }

    [Fact]
    public void Backspace_WithinAComposition_ReachesTheFieldOnceItsLettersAreGone()
    {
        Press(Key.K);
        Press(Key.A);
        Assert.True(Press(Key.Backspace));
        Assert.True(Press(Key.Backspace));
        Assert.False(Press(Key.Backspace));
    }

    [Theory]
    [InlineData(Key.Enter)]
    [InlineData(Key.KeypadEnter)]
    [InlineData(Key.Escape)]
    public void KeyThatEndsAComposition_IsTakenOnce(Key key)
    {
        Press(Key.K);
        Assert.False(Press(Key.Space));
        Assert.True(Press(Key.Down));
        Assert.True(Press(Key.Left));
        Assert.True(Press(key));
        Assert.False(Press(key));
    }

    [Fact]
    public void EnteredText_EndsTheComposition()
    {
        Press(Key.N);
        Press(Key.I);
        Assert.False(Enter("日"));
        Assert.False(Press(Key.Backspace));
    }

    [Fact]
    public void Composition_DoesNotOutliveItsField()
    {
        Press(Key.K);
        Assert.False(_composition.Takes(new KeyReleased(Key.K, KeyModifiers.None), isEditing: false));
        Assert.False(Press(Key.Escape));
        Press(Key.K);
        _composition.Takes(new FocusLost(), isEditing: true);
        Assert.False(Press(Key.Enter));
    }

    [Fact]
    public void LettersOfCommands_AreNoComposition()
    {
        Assert.False(_composition.Takes(new KeyPressed(Key.V, KeyModifiers.Control, false), isEditing: true));
        Assert.False(Press(Key.Enter));
    }

    private bool Press(Key key) => _composition.Takes(new KeyPressed(key, KeyModifiers.None, false), isEditing: true);

    private bool Enter(string text) => _composition.Takes(new TextEntered(text), isEditing: true);
}
