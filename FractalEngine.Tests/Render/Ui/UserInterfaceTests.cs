using FractalEngine.Render.Ui;
using FractalEngine.Render.Ui.Overlays;
using FractalEngine.Render.Ui.Painting;
using FractalEngine.Render.Windowing.Events;
using FractalEngine.Render.Windowing.Keyboard;

namespace FractalEngine.Tests.Render.Ui;

/// <summary>Tests the widgets without a window: events go in, and what is drawn is read as text.</summary>
public class UserInterfaceTests
{
    private readonly UiPanel _panel;
    private readonly UserInterface _ui;
    private Action<UserInterface> _widgets = static _ => { };
    private string _clipboard = "";

    public UserInterfaceTests()
    {
        _panel = new("Panel", ui => _widgets(ui)) { IsOpen = true };
        _ui = new(ui => ui.Panels([_panel]), () => _clipboard, text => _clipboard = text);
    }

    [Fact]
    public void Button_Clicked_IsPressedOnce()
    {
        var count = 0;
        Show(ui => count += ui.Button("press me") ? 1 : 0);
        Click("press me");
        Assert.Equal(1, count);
        // Let go beside the button, nothing is pressed.
        var (x, y) = UiText.Find(_ui, "press me");
        Assert.True(_ui.Handle(new MousePressed(MouseButton.Left, x, y, KeyModifiers.None)));
        Assert.True(_ui.Handle(new MouseMoved(x, y + 200, 0, 200)));
        Assert.True(_ui.Handle(new MouseReleased(MouseButton.Left, x, y + 200, KeyModifiers.None)));
        Assert.Equal(1, count);
    }

    [Fact]
    public void Button_Disabled_TakesNoInput()
    {
        var count = 0;
        Show(ui => count += ui.Button("never", isEnabled: false) ? 1 : 0);
        Click("never");
        Press(Key.Tab);
        Press(Key.Enter);
        Assert.Equal(0, count);
    }

    [Fact]
    public void Handle_Dragged_KeepsThePointerAndTellsOfCtrl()
    {
        var (x, y) = (100.0, 200.0);
        var began = 0;
        UiHandle last = default;
        var ui = new UserInterface(ui =>
        {
            last = ui.Handle("h", "handle", x, y, new(0.2, 0.2, 0.2));
            began += last.Begins ? 1 : 0;
            if (last.IsHeld)
            {
                (x, y) = (last.X, last.Y);
            }
        });
        ui.Update(640, 480);
        Assert.False(ui.Handle(new MousePressed(MouseButton.Left, 300, 300, KeyModifiers.None)));
        ui.Handle(new MouseReleased(MouseButton.Left, 300, 300, KeyModifiers.None));
        Assert.True(ui.Handle(new MousePressed(MouseButton.Left, 102, 201, KeyModifiers.None)));
        var interaction = ui.Interaction;
        Assert.True(ui.Handle(new MouseMoved(400, 50, 298, -151)));
        Assert.True(last.IsHeld);
        Assert.False(last.IsControlHeld);
        Assert.Equal((400.0, 50.0), (x, y));
        // The key belongs to the drag, which stays one step.
        ui.Handle(new KeyPressed(Key.Unknown, KeyModifiers.Control, false));
        ui.Handle(new MouseMoved(410, 60, 10, 10));
        Assert.True(last.IsControlHeld);
        ui.Handle(new KeyReleased(Key.Unknown, KeyModifiers.None));
        ui.Handle(new MouseMoved(411, 60, 1, 0));
        Assert.False(last.IsControlHeld);
        Assert.Equal(interaction, ui.Interaction);
        Assert.True(ui.Handle(new MouseReleased(MouseButton.Left, 411, 60, KeyModifiers.None)));
        ui.Handle(new MouseMoved(20, 20, -391, -40));
        Assert.False(last.IsHeld);
        Assert.Equal((411.0, 60.0), (x, y));
        Assert.Equal(1, began);
    }

    [Fact]
    public void CheckBox_ClickedAndBySpace_Switches()
    {
        var isOn = false;
        Show(ui => isOn ^= ui.CheckBox("switch", isOn));
        Click("switch");
        Assert.True(isOn);
        Assert.True(UiText.Contains(_ui, "✓"));
        // The click gave it the keyboard.
        Assert.True(Press(Key.Space));
        Assert.False(isOn);
    }

    [Fact]
    public void Tab_WalksThroughAllWidgets_AndEscapeGivesTheKeyboardBack()
    {
        var pressed = "";
        Show(ui =>
        {
            foreach (var name in (string[])["a", "b", "c"])
            {
                pressed += ui.Button($"button {name}") ? name : "";
            }
        });
        // The title of the panel comes first.
        Press(Key.Tab);
        foreach (var _ in "abc")
        {
            Press(Key.Tab);
            Press(Key.Enter);
        }

        Press(Key.Tab, KeyModifiers.Shift);
        Press(Key.Space);
        Assert.Equal("abcb", pressed);
        Assert.True(_ui.HasFocus);
        Assert.True(Press(Key.Escape));
        Assert.False(_ui.HasFocus);
        Assert.False(Press(Key.Escape));
    }

    [Fact]
    public void Keys_WithoutAMeaningForTheWidget_GoToTheScene()
    {
        var value = 5.0;
        Show(ui => ui.Slider("number", ref value, 0, 10));
        Assert.False(Press(Key.W));
        Click("number", 150);
        Press(Key.Escape);
        Press(Key.Tab);
        Press(Key.Tab);
        Assert.False(Press(Key.W));
        Assert.False(Press(Key.Up));
        Assert.True(Press(Key.Right));
    }

    [Fact]
    public void Slider_Dragged_FollowsThePointerWithinItsRange()
    {
        var value = 2.0;
        var changes = 0;
        Show(ui => changes += ui.Slider("number", ref value, 0, 10, 0.5) ? 1 : 0);
        var (x, y) = UiText.Find(_ui, "number");
        x += 100;
        _ui.Handle(new MousePressed(MouseButton.Left, x, y, KeyModifiers.None));
        Assert.Equal(2, value);
        var interaction = _ui.Interaction;
        _ui.Handle(new MouseMoved(x + 40, y, 40, 0));
        Assert.InRange(value, 2.5, 6);
        Assert.Equal(0, value % 0.5);
        _ui.Handle(new MouseMoved(x + 4000, y, 4000, 0));
        Assert.Equal(10, value);
        _ui.Handle(new MouseMoved(x - 4000, y, -8000, 0));
        Assert.Equal(0, value);
        Assert.Equal(interaction, _ui.Interaction);
        _ui.Handle(new MouseReleased(MouseButton.Left, x - 4000, y, KeyModifiers.None));
        Assert.Equal(3, changes);
    }

    [Theory]
    [InlineData("7.25", true, 7.25)]
    [InlineData("-1e2", true, 0)]
    [InlineData("-1e2", false, -100)]
    [InlineData("nonsense", true, 2)]
    [InlineData("1e999", false, 2)]
    [InlineData("7,5", true, 2)]
    public void Slider_Typed_TakesNumbersOnly(string typed, bool isBounded, double expected)
    {
        var value = 2.0;
        Show(ui => ui.Slider("number", ref value, 0, 10, 0, isBounded));
        Click("number", 150);
        Type(typed);
        Press(Key.Enter);
        Assert.Equal(expected, value);
        Assert.False(_ui.HasFocus);
    }

    [Fact]
    public void Slider_TypedAndLeftByTab_TakesTheNumber_ButNotAfterEscape()
    {
        var value = 2.0;
        Show(ui => ui.Slider("number", ref value, 0, 10));
        Click("number", 150);
        Type("3");
        Press(Key.Tab);
        Assert.Equal(3, value);
        Click("number", 150);
        Type("4");
        Press(Key.Escape);
        Assert.Equal(3, value);
    }

    [Fact]
    public void Slider_ByKeys_MovesBySteps()
    {
        var value = 2.0;
        Show(ui => ui.Slider("number", ref value, 0, 10, 0.5));
        Press(Key.Tab);
        Press(Key.Tab);
        Press(Key.Right);
        Assert.Equal(2.5, value);
        Press(Key.Left, KeyModifiers.Shift);
        Assert.Equal(0, value);
    }

    [Fact]
    public void TextField_EditedByKeys_HasTheText()
    {
        var text = "old";
        Show(ui => ui.TextField("name", ref text));
        Click("old");
        Type("a büg");
        Press(Key.Left);
        Press(Key.Backspace);
        Type("o");
        Press(Key.Home);
        Press(Key.Delete);
        Press(Key.Delete);
        Press(Key.End);
        Type("😀");
        Press(Key.Backspace);
        Assert.Equal("bog", text);
    }

    [Fact]
    public void TextField_Clipboard_CopiesCutsAndPastes()
    {
        var text = "one two";
        Show(ui => ui.TextField("name", ref text));
        Click("one two");
        Press(Key.C, KeyModifiers.Control);
        Assert.Equal("one two", _clipboard);
        Press(Key.End);
        Press(Key.Left, KeyModifiers.Control | KeyModifiers.Shift);
        Press(Key.X, KeyModifiers.Control);
        Assert.Equal("two", _clipboard);
        Assert.Equal("one ", text);
        _clipboard = "three\n";
        Press(Key.V, KeyModifiers.Control);
        Assert.Equal("one three", text);
        Press(Key.A, KeyModifiers.Control);
        Press(Key.Backspace);
        Assert.Equal("", text);
    }

    [Fact]
    public void TextField_DraggedOver_SelectsThePart()
    {
        var text = "abcdefgh";
        Show(ui => ui.TextField("name", ref text));
        Click("abcdefgh");
        var (x, y) = UiText.Find(_ui, "abcdefgh", centred: false);
        _ui.Handle(new MousePressed(MouseButton.Left, x + 16, y, KeyModifiers.None));
        _ui.Handle(new MouseMoved(x + 40, y, 24, 0));
        _ui.Handle(new MouseReleased(MouseButton.Left, x + 40, y, KeyModifiers.None));
        Type("-");
        Assert.Equal("ab-fgh", text);
    }

    [Fact]
    public void TextField_TakesLettersFromTheScene_ButNotFunctionKeys()
    {
        var text = "";
        Show(ui => ui.TextField("name", ref text, takesKeyboard: text.Length == 0));
        Assert.True(Press(Key.W));
        Assert.False(Press(Key.F12));
        Assert.False(Press(Key.S, KeyModifiers.Control));
    }

    [Fact]
    public void Branch_ClickedAndByArrows_OpensAndCloses()
    {
        var isOpen = false;
        Show(ui =>
        {
            if (ui.Branch("objects", ref isOpen))
            {
                ui.Selectable("leaf", isSelected: false, depth: 1);
            }
        });
        Assert.False(UiText.Contains(_ui, "leaf"));
        Click("objects");
        Assert.True(UiText.Contains(_ui, "leaf"));
        Press(Key.Left);
        Assert.False(UiText.Contains(_ui, "leaf"));
        Press(Key.Right);
        Press(Key.Down);
        Press(Key.Up);
        Press(Key.Left);
        Assert.False(isOpen);
    }

    [Fact]
    public void Rows_OfAMillion_BuildsTheVisibleOnes_AndTheWheelScrolls()
    {
        var built = new List<int>();
        Show(ui =>
        {
            built.Clear();
            ui.Rows(1_000_000, i =>
            {
                built.Add(i);
                ui.Selectable($"row {i}", isSelected: false);
            });
        });
        Assert.InRange(built.Count, 10, 60);
        Assert.Equal(0, built[0]);
        var (x, y) = UiText.Find(_ui, "row 3");
        _ui.Handle(new MouseMoved(x, y, 0, 0));
        Assert.True(_ui.Handle(new WheelTurned(-10, KeyModifiers.None)));
        Assert.Equal(30, built[0]);
        Assert.True(_ui.Handle(new WheelTurned(100, KeyModifiers.None)));
        Assert.Equal(0, built[0]);
        // A touchpad turns by small parts of a notch.
        for (var i = 0; i < 8; i++)
        {
            Assert.True(_ui.Handle(new WheelTurned(-0.125, KeyModifiers.None)));
        }

        Assert.Equal(3, built[0]);
    }

    [Fact]
    public void Panel_Folded_Closed_Dragged_StaysWhereItIsPut()
    {
        Show(static ui => ui.Label("contents"));
        Click("Panel");
        Assert.True(_panel.IsFolded);
        Assert.False(UiText.Contains(_ui, "contents"));
        Click("Panel");
        var (x, y) = UiText.Find(_ui, "Panel");
        _ui.Handle(new MousePressed(MouseButton.Left, x, y, KeyModifiers.None));
        _ui.Handle(new MouseMoved(x + 200, y + 100, 200, 100));
        _ui.Handle(new MouseReleased(MouseButton.Left, x + 200, y + 100, KeyModifiers.None));
        Assert.Equal((UiDock.Floating, 200.0, 100.0), (_panel.Dock, _panel.X, _panel.Y));
        Assert.False(_panel.IsFolded);
        (x, y) = UiText.Find(_ui, "Panel");
        _ui.Handle(new MousePressed(MouseButton.Left, x, y, KeyModifiers.None));
        _ui.Handle(new MouseMoved(795, y, 200, 0));
        _ui.Handle(new MouseReleased(MouseButton.Left, 795, y, KeyModifiers.None));
        Assert.Equal(UiDock.Right, _panel.Dock);
        Assert.Equal(800, _panel.Bounds.Right);
        Click("×");
        Assert.False(_panel.IsOpen);
        Assert.False(_ui.Handle(new MousePressed(MouseButton.Left, 700, 50, KeyModifiers.None)));
    }

    [Fact]
    public void Input_BesidePanels_GoesToTheScene()
    {
        Show(static ui => ui.Label("contents"));
        Assert.False(_ui.Handle(new MouseMoved(700, 400, 0, 0)));
        Assert.False(_ui.Handle(new WheelTurned(1, KeyModifiers.None)));
        Assert.False(_ui.Handle(new MousePressed(MouseButton.Left, 700, 400, KeyModifiers.None)));
        // A drag that began in the scene goes on over a panel.
        Assert.False(_ui.Handle(new MouseMoved(20, 20, -680, -380)));
        Assert.False(_ui.Handle(new MouseReleased(MouseButton.Left, 20, 20, KeyModifiers.None)));
        Assert.True(_ui.Handle(new WheelTurned(1, KeyModifiers.None)));
        Assert.True(_ui.Handle(new MousePressed(MouseButton.Right, 20, 20, KeyModifiers.None)));
        Assert.True(_ui.Handle(new MouseReleased(MouseButton.Right, 20, 20, KeyModifiers.None)));
    }

    [Fact]
    public void Version_WithoutAChange_Stays()
    {
        Show(static ui => ui.Button("press me"));
        var version = _ui.Version;
        _ui.Update(800, 600);
        _ui.Handle(new MouseMoved(790, 590, 1, 1));
        Assert.Equal(version, _ui.Version);
        var (x, y) = UiText.Find(_ui, "press me");
        _ui.Handle(new MouseMoved(x, y, 1, 1));
        Assert.NotEqual(version, _ui.Version);
    }

    [Fact]
    public void Tooltip_OfTheWidgetUnderThePointer_IsShown()
    {
        Show(static ui =>
        {
            ui.Button("one");
            ui.Tooltip("explains one");
            ui.Button("two");
            ui.Tooltip("explains two");
        });
        var (x, y) = UiText.Find(_ui, "two");
        _ui.Handle(new MouseMoved(x, y, 1, 1));
        Assert.True(UiText.Contains(_ui, "explains two"));
        Assert.False(UiText.Contains(_ui, "explains one"));
        // Beside the panel, of which it covers no row.
        Assert.True(UiText.Find(_ui, "explains two").X > _panel.Bounds.Right || UiText.Find(_ui, "explains two").X < _panel.Bounds.X);
    }

    [Fact]
    public void FloatingPanel_InAWindowOfAnyWidth_IsBuilt()
    {
        var panel = new UiPanel("one", static ui => ui.Label("text")) { IsOpen = true, Dock = UiDock.Floating, X = 300, Y = 200 };
        var ui = new UserInterface(ui => ui.Panels([panel], bottomMargin: 1));
        for (var size = 1; size <= 200; size++)
        {
            ui.Update(size, size);
            Assert.True(panel.Bounds.X < Math.Max(size, 64), $"{size}: {panel.Bounds}");
        }
    }

    [Theory]
    [InlineData(700, 400)]
    [InlineData(900, 600)]
    [InlineData(1280, 720)]
    public void Tooltip_BetweenTwoColumns_CoversNoPanel(int width, int height)
    {
        var panels = new[] { UiDock.Left, UiDock.Right }.Select(dock => new UiPanel($"{dock}", ui =>
        {
            ui.Button($"at the {dock}");
            ui.Tooltip("explains the button in so many words that they need more than one line beside a panel");
        })
        {
            IsOpen = true,
            Dock = dock,
        }).ToArray();
        var ui = new UserInterface(ui => ui.Panels([.. panels], bottomMargin: 2));
        ui.Update(width, height);
        foreach (var panel in panels)
        {
            var (x, y) = UiText.Find(ui, $"at the {panel.Dock}");
            ui.Handle(new MouseMoved(x, y, 1, 1));
            var (left, middle) = UiText.Find(ui, "explains the", centred: false);
            Assert.DoesNotContain(panels, other => other.Bounds.Contains(left, middle));
            Assert.InRange(middle, 0, height);
        }
    }

    [Fact]
    public void SceneArea_BeforePanelsAreAdded_IsTheAreaWithoutThem()
    {
        var seen = default(UiRect);
        var panel = new UiPanel("one", static ui => ui.Label("text")) { IsOpen = true, Dock = UiDock.Right };
        var ui = new UserInterface(ui =>
        {
            seen = ui.SceneArea;
            ui.Panels([panel]);
        });
        ui.Update(800, 600);
        Assert.Equal(new(0, 0, panel.Bounds.X, 600), seen);
    }

    [Fact]
    public void Columns_OfManyPanels_ShareTheHeight()
    {
        var panels = Enumerable.Range(0, 4).Select(i => new UiPanel($"panel {i}", ui =>
        {
            for (var k = 0; k < (i == 0 ? 2 : 40); k++)
            {
                ui.Label($"line {k}");
            }
        })
        {
            IsOpen = true,
        }).ToArray();
        var ui = new UserInterface(ui => ui.Panels([.. panels], bottomMargin: 1));
        ui.Update(700, 400);
        for (var i = 0; i < 4; i++)
        {
            Assert.True(panels[i].Bounds.Bottom <= 400 && panels[i].Bounds.Height > 60, $"{panels[i].Bounds}");
            Assert.True(i == 0 || panels[i].Bounds.Y > panels[i - 1].Bounds.Bottom - 1);
        }
    }

    [Theory]
    [InlineData(0.8)]
    [InlineData(1)]
    [InlineData(1.25)]
    [InlineData(2)]
    [InlineData(3)]
    public void Scale_OfAnySize_KeepsTextInsideItsPanel(double scale)
    {
        Show(static ui => ui.Button("press me"));
        _ui.Scale = scale;
        _ui.Update(1280, 720);
        Assert.All(_ui.Quads, quad => Assert.True(
            quad.X >= 0 && quad.X + quad.Width <= _panel.Bounds.Right && quad.Y + quad.Height <= _panel.Bounds.Bottom, $"{quad}"));
        Click("press me");
    }

    [Fact]
    public void Themes_AllTexts_ContrastWithTheirGrounds()
    {
        foreach (var theme in (UiTheme[])[UiTheme.Dark, UiTheme.Light])
        {
            foreach (var ground in (Core.Geometry.Colour[])
                [theme.Panel, theme.Title, theme.Control, theme.HotControl, theme.Field, theme.Fill, theme.Selection])
            {
                Assert.True(Contrast(theme.Text, ground) >= 4.5, $"text on {ground}");
            }

            foreach (var (text, grounds) in ((Core.Geometry.Colour, Core.Geometry.Colour[])[])
            [
                (theme.DimText, [theme.Panel, theme.Title, theme.Field, theme.Control]),
                (theme.Accent, [theme.Panel, theme.Title, theme.Control]),
                (theme.Warning, [theme.Panel]),
            ])
            {
                Assert.All(grounds, ground => Assert.True(Contrast(text, ground) >= 4.5, $"{text} on {ground}"));
            }
        }

        // Texts over the scene, at worst a white one.
        var (red, green, blue) = OverlayLayout.PanelColour;
        const double alpha = OverlayLayout.PanelOpacity;
        const double scene = 1 - alpha;
        var overWhite = new Core.Geometry.Colour(scene + (alpha * red), scene + (alpha * green), scene + (alpha * blue));
        Assert.All(
            Enum.GetValues<OverlayTone>(), tone => Assert.InRange(Contrast(OverlayLayout.ColourOf(tone), overWhite), 4.5, 21));
        Assert.Equal(21, Contrast(Core.Geometry.Colour.Black, Core.Geometry.Colour.White), 6);
    }

    /// <summary>Computes the contrast of two colours by WCAG 2.1, from 1 to 21.</summary>
    private static double Contrast(Core.Geometry.Colour colour1, Core.Geometry.Colour colour2)
    {
        double luminance1 = Luminance(colour1);
        double luminance2 = Luminance(colour2);
        return (Math.Max(luminance1, luminance2) + 0.05) / (Math.Min(luminance1, luminance2) + 0.05);
    }

    private static double Luminance(Core.Geometry.Colour colour) =>
        (0.2126 * Linear(colour.Red)) + (0.7152 * Linear(colour.Green)) + (0.0722 * Linear(colour.Blue));

    private static double Linear(double value) => value <= 0.04045 ? value / 12.92 : Math.Pow((value + 0.055) / 1.055, 2.4);

    private void Show(Action<UserInterface> widgets)
    {
        _widgets = widgets;
        _ui.Update(800, 600);
    }

    private void Click(string text, int right = 0)
    {
        var (x, y) = UiText.Find(_ui, text);
        _ui.Handle(new MouseMoved(x + right, y, 0, 0));
        _ui.Handle(new MousePressed(MouseButton.Left, x + right, y, KeyModifiers.None));
        _ui.Handle(new MouseReleased(MouseButton.Left, x + right, y, KeyModifiers.None));
    }

    private bool Press(Key key, KeyModifiers modifiers = KeyModifiers.None) => _ui.Handle(new KeyPressed(key, modifiers, IsRepeat: false));

    private void Type(string text)
    {
        _ui.Handle(new KeyPressed(Key.Unknown, KeyModifiers.None, IsRepeat: false));
        _ui.Handle(new TextEntered(text));
    }
}
