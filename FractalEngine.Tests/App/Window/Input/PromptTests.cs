using System.Collections.Immutable;
using FractalEngine.App.Window.Files;
using FractalEngine.App.Window.Input;
using FractalEngine.Parsing.Editing;
using FractalEngine.Render.Windowing.Events;
using FractalEngine.Render.Windowing.Keyboard;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.App.Window.Input;

/// <summary>Tests questions of the window without a window.</summary>
public sealed class PromptTests : IDisposable
{
    private readonly TemporaryFolder _folder = new();

    public void Dispose() => _folder.Dispose();

    [Fact]
    public void TextPrompt_Edited_HasTheText()
    {
        var prompt = new TextPrompt("", "ab", static _ => null);
        Press(prompt, Key.Left);
        prompt.HandleText("ü😀");
        Press(prompt, Key.Backspace, Key.Home);
        prompt.HandleText("x");
        Press(prompt, Key.End, Key.Backspace, Key.Home, Key.Delete);
        Assert.Equal("aü", prompt.Text);
        // Nothing is selected, which would be replaced unseen.
        prompt.HandleKey(new(Key.A, KeyModifiers.Control, false));
        prompt.HandleKey(new(Key.Right, KeyModifiers.Shift, false));
        prompt.HandleText("\tb");
        Assert.Equal("abü", prompt.Text);
        prompt.HandleKey(new(Key.Backspace, KeyModifiers.Control, false));
        Assert.Equal("aü", prompt.Text);
        prompt.HandleKey(new(Key.U, KeyModifiers.Control, false));
        Assert.Equal("", prompt.Text);
    }

    [Fact]
    public void TextPrompt_WithSuggestions_CompletesAndPicks()
    {
        var accepted = new List<string>();
        var prompt = new TextPrompt("", "", Accept, Suggest);
        prompt.HandleText("s");
        Press(prompt, Key.Tab);
        Assert.Equal("scene-", prompt.Text);
        Press(prompt, Key.Home, Key.Delete, Key.End);
        prompt.HandleKey(new(Key.U, KeyModifiers.Control, false));
        Press(prompt, Key.Up, Key.Enter);
        Assert.Equal("folder/", prompt.Text);
        Assert.False(prompt.IsClosed);
        Assert.Contains("a folder", prompt.Panel.Lines.Select(line => line.Text));
        prompt.HandleKey(new(Key.U, KeyModifiers.Control, false));
        Press(prompt, Key.Down, Key.Down, Key.Enter);
        Assert.True(prompt.IsClosed);
        Assert.Equal(["folder/", "scene-2"], accepted);

        string? Accept(string text)
        {
            accepted.Add(text);
            return text.EndsWith('/') ? "a folder" : null;
        }

        static ImmutableArray<string> Suggest(string text) =>
            [.. ((string[])["scene-1", "scene-2", "folder/"]).Where(item => item.StartsWith(text, StringComparison.Ordinal))];
    }

    [Fact]
    public void PromptHost_OpenedByAKey_IgnoresTheTextOfThatKey()
    {
        var host = new PromptHost(static () => "");
        var text = new TextPrompt("", "", static _ => null);
        Assert.False(host.Handle(new KeyPressed(Key.O, KeyModifiers.Control, false)));
        host.Open(new ChoicePrompt("", [], new PromptChoice(Key.A, "", () => host.Open(text))));
        host.KeyHandled();
        Assert.True(host.Handle(new KeyPressed(Key.A, KeyModifiers.None, false)));
        Assert.True(host.Handle(new TextEntered("a")));
        Assert.Equal("", text.Text);
        host.Handle(new KeyPressed(Key.B, KeyModifiers.None, false));
        host.Handle(new TextEntered("b"));
        Assert.Equal("b", text.Text);
        Assert.False(host.Handle(new KeyReleased(Key.B, KeyModifiers.None)));
        host.Handle(new KeyPressed(Key.Escape, KeyModifiers.None, false));
        Assert.Null(host.Current);
    }

    [Fact]
    public void PromptHost_OnAClickOnALine_TakesItsAnswer()
    {
        var host = new PromptHost(static () => "");
        var chosen = "";
        var prompt = new ChoicePrompt(
            "?", ["a detail"],
            new PromptChoice(Key.A, "first", () => chosen += "a"), new PromptChoice(Key.B, "second", () => chosen += "b"));
        Assert.Equal([null, 0, 1, 2], prompt.Panel.Lines.Select(static line => line.Answer));
        host.Open(prompt);
        host.Answer(1);
        Assert.Equal(("b", null), (chosen, host.Current));
        host.Open(new ChoicePrompt("?", [], new PromptChoice(Key.A, "first", () => chosen += "a")));
        host.Answer(1);
        Assert.Equal(("b", null), (chosen, host.Current));
        var accepted = "";
        host.Open(new TextPrompt("", "", text => (accepted = text) is null ? "" : null, static _ => ["one", "two"]));
        host.Answer(1);
        Assert.Equal(("two", null), (accepted, host.Current));
    }

    [Fact]
    public void PromptHost_OnControlV_EntersTheClipboardInOneLine()
    {
        var host = new PromptHost(static () => "b/ä c.sdo\r\n");
        var text = new TextPrompt("", "a/", static _ => null);
        host.Open(text);
        Assert.True(host.Handle(new KeyPressed(Key.V, KeyModifiers.Control, false)));
        Assert.Equal("a/b/ä c.sdo", text.Text);
        host.Handle(new KeyPressed(Key.V, KeyModifiers.None, false));
        Assert.Equal("a/b/ä c.sdo", text.Text);
    }

    [Fact]
    public void PathCompletion_SuggestsFoldersAndFilesThatCanBeOpened()
    {
        foreach (var name in (string[])["b.sdo", "a.obj.gz", "text.txt", ".hidden.sdo", "inner/x.fdo"])
        {
            _folder.Write(name, "");
        }

        var root = _folder.Path + "/";
        Assert.Equal([root + "inner/", root + "a.obj.gz", root + "b.sdo"], PathCompletion.Suggest(root).AsEnumerable());
        Assert.Equal([root + "inner/x.fdo"], PathCompletion.Suggest(root + "inner/").AsEnumerable());
        Assert.Equal([root + ".hidden.sdo"], PathCompletion.Suggest(root + ".h").AsEnumerable());
        Assert.Empty(PathCompletion.Suggest(root + "missing/"));
        Assert.Empty(PathCompletion.Suggest("\0/"));
    }

    [Fact]
    public void RecentFiles_AreKeptInOrderAndOnce()
    {
        var messages = new List<string>();
        var recent = new RecentFiles(_folder["config/recent.txt"], messages.Add);
        Assert.Empty(recent.Read());
        for (var i = 0; i < 12; i++)
        {
            recent.Add($"/folder/{i % 11}");
        }

        Assert.Equal(
            ((int[])[0, 10, 9, 8, 7, 6, 5, 4, 3, 2]).Select(i => $"/folder/{i}"),
            recent.Read().AsEnumerable());
        Assert.Empty(messages);
    }

    [Theory]
    [InlineData(new byte[] { 0xFF, 0xFE, 0x00 })]
    [InlineData(new byte[] { (byte)'n', (byte)'o', (byte)'\n' })]
    [InlineData(new byte[] { (byte)'/', 0, (byte)'\n' })]
    public void RecentFiles_Broken_AreIgnoredWithOneMessage(byte[] bytes)
    {
        var messages = new List<string>();
        File.WriteAllBytes(_folder["recent.txt"], bytes);
        var recent = new RecentFiles(_folder["recent.txt"], messages.Add);
        Assert.Empty(recent.Read());
        Assert.Empty(recent.Read());
        Assert.Contains("recent.txt", Assert.Single(messages), StringComparison.Ordinal);
        recent.Add("/folder/file");
        Assert.Equal(["/folder/file"], recent.Read().AsEnumerable());
    }

    [Fact]
    public void UndoHistory_KeepsAHundredSteps()
    {
        var history = new UndoHistory<int>(0);
        for (var i = 1; i <= 150; i++)
        {
            history = history.Record(i).Record(i);
        }

        var count = 0;
        while (history.Undo() is { } undone)
        {
            history = undone;
            count++;
        }

        Assert.Equal((100, 50), (count, history.Present));
        history = history.Redo()!.Record(51).Redo()!.Record(-1);
        Assert.Null(history.Redo());
        Assert.Equal(52, history.Undo()!.Present);
    }

    private static void Press(Prompt prompt, params Key[] keys)
    {
        foreach (var key in keys)
        {
            prompt.HandleKey(new(key, KeyModifiers.None, false));
        }
    }
}
