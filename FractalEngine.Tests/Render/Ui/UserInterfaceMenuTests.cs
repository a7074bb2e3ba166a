using FractalEngine.Render.Ui;
using FractalEngine.Render.Windowing.Events;
using FractalEngine.Render.Windowing.Keyboard;

namespace FractalEngine.Tests.Render.Ui;

/// <summary>Tests menus and dialogs without a window.</summary>
public class UserInterfaceMenuTests
{
    private readonly List<string> _chosen = [];
    private readonly UserInterface _ui;
    private string _search = "";
    private bool _isFirst = true;

    public UserInterfaceMenuTests()
    {
        var list = new UiPanel("list", static ui => ui.Label("entry"));
        _ui = new(ui =>
        {
            ui.MenuBar(() =>
            {
                ui.Menu("File", () => AddItems(ui, "Open", "Save"), 12);
                ui.Menu("Edit", () => AddItems(ui, "Undo"), 12);
            });
            ui.Dialog("Question", () => ui.TextField("search", ref _search, _isFirst), list);
            _isFirst = false;
        });
        _ui.Update(640, 480);
    }

    [Fact]
    public void Menu_OfTheMouse_OpensChoosesAndCloses()
    {
        Click("File");
        Assert.True(UiText.Contains(_ui, "Save"));
        Assert.True(_ui.IsModal);
        Click("Save");
        Assert.Equal(["Save"], _chosen);
        Assert.False(UiText.Contains(_ui, "Save"));
        Click("Edit");
        // A click beside it closes it, and the scene does not see the click.
        Assert.True(_ui.Handle(new MousePressed(MouseButton.Left, 500, 400, KeyModifiers.None)));
        _ui.Handle(new MouseReleased(MouseButton.Left, 500, 400, KeyModifiers.None));
        Assert.False(UiText.Contains(_ui, "Undo"));
        Assert.False(_ui.Handle(new MousePressed(MouseButton.Left, 500, 400, KeyModifiers.None)));
    }

    [Fact]
    public void Menu_TooHighForTheFrame_HasColumnsWithinIt()
    {
        string[] items = [.. Enumerable.Range(10, 30).Select(static i => $"Item {i}")];
        var ui = new UserInterface(ui => ui.MenuBar(() => ui.Menu("Long", () => AddItems(ui, items), 12, items.Length)));
        ui.Update(640, 360);
        var (x, y) = UiText.Find(ui, "Long");
        ui.Handle(new MousePressed(MouseButton.Left, x, y, KeyModifiers.None));
        ui.Handle(new MouseReleased(MouseButton.Left, x, y, KeyModifiers.None));
        Assert.All(items, item => Assert.InRange(UiText.Find(ui, item).Y, 20, 350));
        Assert.All(items, item => Assert.InRange(UiText.Find(ui, item).X, 20, 620));
    }

    [Theory]
    [InlineData(640, true)]
    [InlineData(90, false)]
    public void Menu_InANarrowFrame_LeavesItsKeysOut(int width, bool hasKeys)
    {
        var ui = new UserInterface(ui => ui.MenuBar(() => ui.Menu("File", () => ui.MenuItem("Save as", "Ctrl+S"), 16)));
        ui.Update(width, 100);
        var (x, y) = UiText.Find(ui, "File");
        ui.Handle(new MousePressed(MouseButton.Left, x, y, KeyModifiers.None));
        Assert.True(UiText.Contains(ui, "Save as"));
        Assert.Equal(hasKeys, UiText.Contains(ui, "Ctrl+S"));
    }

    [Fact]
    public void Menu_OpenWhileThePointerMovesOn_Follows()
    {
        Click("File");
        var (x, y) = UiText.Find(_ui, "Edit");
        _ui.Handle(new MouseMoved(x, y, 0, 0));
        Assert.True(UiText.Contains(_ui, "Undo"));
        Assert.False(UiText.Contains(_ui, "Save"));
    }

    [Fact]
    public void Menu_OfTheKeyboard_IsWalkedByArrows()
    {
        Assert.True(Press(Key.F10));
        Assert.True(UiText.Contains(_ui, "Open"));
        Press(Key.Down);
        Press(Key.Enter);
        Press(Key.F10);
        Press(Key.Right);
        Press(Key.Enter);
        Press(Key.F10);
        Press(Key.Left);
        Press(Key.Left);
        Press(Key.Enter);
        Assert.Equal(["Save", "Undo", "Open"], _chosen);
        Press(Key.F10);
        Assert.True(Press(Key.Escape));
        Assert.False(_ui.IsModal);
        Assert.False(Press(Key.Escape));
    }

    [Fact]
    public void Dialog_Open_TakesAllInputUntilEscape()
    {
        Open();
        Assert.True(UiText.Contains(_ui, "Question"));
        Assert.True(UiText.Contains(_ui, "entry"));
        Assert.True(_ui.Handle(new WheelTurned(1, KeyModifiers.None)));
        _ui.Handle(new KeyPressed(Key.X, KeyModifiers.None, false));
        _ui.Handle(new TextEntered("x"));
        Assert.Equal("x", _search);
        Assert.True(Press(Key.Escape));
        Assert.False(UiText.Contains(_ui, "Question"));
        Assert.False(Press(Key.Escape));
    }

    [Fact]
    public void Dialog_OpenedByAKey_IgnoresTheTextOfThatKey()
    {
        Assert.False(Press(Key.H));
        Open();
        Assert.True(_ui.Handle(new TextEntered("h")));
        Assert.Equal("", _search);
        Press(Key.H);
        _ui.Handle(new TextEntered("h"));
        Assert.Equal("h", _search);
    }

    [Fact]
    public void Dialog_ClickedBeside_Closes()
    {
        Open();
        Assert.True(_ui.Handle(new MousePressed(MouseButton.Left, 5, 470, KeyModifiers.None)));
        Assert.False(UiText.Contains(_ui, "Question"));
    }

    [Fact]
    public void Dialog_ClosedByItsButton_GivesTheKeyboardBack()
    {
        Open();
        Click("×");
        Assert.False(UiText.Contains(_ui, "Question"));
        Assert.False(_ui.IsModal);
        Assert.False(Press(Key.W));
    }

    [Fact]
    public void Dialog_NotBuiltAnyMore_GivesTheKeyboardBack()
    {
        var isBuilt = true;
        var list = new UiPanel("list", static ui => ui.Label("entry"));
        var ui = new UserInterface(ui => _ = isBuilt && ui.Dialog("Question", () => ui.TextField("search", ref _search, true), list));
        ui.OpenDialog("Question");
        ui.Update(640, 480);
        ui.Handle(new KeyPressed(Key.X, KeyModifiers.None, IsRepeat: false));
        Assert.True(ui.Handle(new TextEntered("x")));
        isBuilt = false;
        ui.Update(640, 480);
        Assert.False(ui.IsModal);
        Assert.False(ui.Handle(new TextEntered("y")));
        Assert.Equal("x", _search);
    }

    private void Open()
    {
        _isFirst = true;
        _ui.OpenDialog("Question");
        _ui.Update(640, 480);
    }

    private void AddItems(UserInterface ui, params string[] items)
    {
        foreach (var item in items)
        {
            if (ui.MenuItem(item, "Ctrl+X"))
            {
                _chosen.Add(item);
            }
        }
    }

    private void Click(string text)
    {
        var (x, y) = UiText.Find(_ui, text);
        _ui.Handle(new MouseMoved(x, y, 0, 0));
        _ui.Handle(new MousePressed(MouseButton.Left, x, y, KeyModifiers.None));
        _ui.Handle(new MouseReleased(MouseButton.Left, x, y, KeyModifiers.None));
    }

    private bool Press(Key key) => _ui.Handle(new KeyPressed(key, KeyModifiers.None, IsRepeat: false));
}
