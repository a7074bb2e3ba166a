using FractalEngine.Render.Ui;
using FractalEngine.Render.Ui.Overlays;
using FractalEngine.Render.Windowing.Events;
using FractalEngine.Render.Windowing.Keyboard;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Render.Ui;

/// <summary>Tests where panels and their rows stand, and what sliders keep, without a window.</summary>
public class UserInterfaceLayoutTests
{
    private readonly UiPanel _left;
    private readonly UiPanel _right;
    private readonly UserInterface _ui;
    private Action<UserInterface> _widgets = static _ => { };

    public UserInterfaceLayoutTests()
    {
        _left = new("Left", ui => _widgets(ui)) { IsOpen = true };
        _right = new("Right", static ui => ui.Label("right")) { Dock = UiDock.Right };
        _ui = new(ui =>
        {
            ui.MenuBar(static () => { });
            ui.Panels([_left, _right]);
        });
    }

    [Fact]
    public void ViewArea_BesidePanels_IsWhatTheyLeave()
    {
        Show(static ui => ui.Label("a"), 1200);
        var area = _ui.ViewArea;
        Assert.Equal((_left.Bounds.Right, 1200, 0, 600), (area.X, area.Right, area.Y, area.Height));
        // What is shown in a panel changes nothing.
        Show(static ui => ui.Paragraph(string.Join('\n', Enumerable.Repeat("line", 20))), 1200);
        Assert.Equal(area, _ui.ViewArea);
        _right.IsOpen = true;
        _ui.Update(1200, 600);
        Assert.Equal((_left.Bounds.Right, _right.Bounds.X), (_ui.ViewArea.X, _ui.ViewArea.Right));
        // Folded, and in front of the scene, panels leave the whole frame.
        _right.Dock = UiDock.Floating;
        _left.IsFolded = true;
        _ui.Update(1200, 600);
        Assert.Equal(new(0, 0, 1200, 600), _ui.ViewArea);
        // Two columns that leave too little likewise.
        (_right.Dock, _left.IsFolded) = (UiDock.Right, false);
        _ui.Update(640, 600);
        Assert.Equal(new(0, 0, 640, 600), _ui.ViewArea);
    }

    /// <summary>The filled part would jump to the middle where the ends follow the number.</summary>
    [Fact]
    public void Slider_WhoseEndsFollowTheNumber_KeepsThemWhileTheNumberIsWithin()
    {
        var value = 0.0;
        Show(ui => ui.Slider("n", ref value, value - 1, value + 1, 0.01, isBounded: false));
        Drag("n", 100, 40);
        var first = value;
        Assert.InRange(first, 0.1, 0.9);
        var fill = FilledWidth();
        // Another drag goes on from there, by as much for as many pixels.
        Drag("n", 100, 20);
        Assert.Equal(1.5 * first, value, 0.02);
        Assert.InRange(FilledWidth() - fill, 18, 22);
        // A number beyond the ends has new ones about it.
        Drag("n", 100, -400);
        Assert.Equal(-1, value);
        Drag("n", 100, -40);
        Assert.InRange(value, -1.9, -1.1);
        // Likewise one of another size, as another object may have.
        value = 0;
        Show(ui => ui.Slider("n", ref value, value - 100, value + 100, 0.01, isBounded: false));
        Drag("n", 100, 40);
        Assert.InRange(value, 10, 90);
    }

    [Fact]
    public void ScrollHere_ToARow_BringsItIntoView()
    {
        var target = -1;
        Show(ui =>
        {
            for (var i = 0; i < 100; i++)
            {
                if (i == target)
                {
                    target = -1;
                    ui.ScrollHere(2);
                }

                ui.Row(1);
                ui.Label($"row {i}.");
            }
        });
        Assert.False(UiText.Contains(_ui, "row 70."));
        target = 70;
        _ui.Update(800, 600);
        Assert.True(UiText.Contains(_ui, "row 70."));
        Assert.True(UiText.Contains(_ui, "row 71."));
        target = 3;
        _ui.Update(800, 600);
        Assert.True(UiText.Contains(_ui, "row 3."));
        Assert.False(UiText.Contains(_ui, "row 70."));
    }

    [Fact]
    public void Heading_TooLongForItsPanel_IsWrapped()
    {
        Show(static ui => ui.Heading("a heading that is longer than the panel is wide"));
        Assert.True(UiText.Contains(_ui, "a heading that is longer than the"));
        Assert.True(UiText.Contains(_ui, "panel is wide"));
    }

    [Fact]
    public void Progress_OfAFraction_FillsIt()
    {
        Show(static ui => ui.Progress(0.25, "a quarter"));
        var quarter = FilledWidth();
        Show(static ui => ui.Progress(0.5, "a half"));
        Assert.Equal(2 * quarter, FilledWidth(), 2f);
        Assert.True(UiText.Contains(_ui, "a half"));
        Show(static ui => ui.Progress(7, "all"));
        Assert.Equal(4 * quarter, FilledWidth(), 4f);
    }

    [Fact]
    public void Graph_OfValues_HasAColumnForEach()
    {
        int Columns() => _ui.Quads.Count(quad => quad.Glyph < 0 && quad.Width == 2);
        Show(static ui => ui.Graph([], 1));
        var before = Columns();
        Show(static ui => ui.Graph([0.5, 0.25, 1], 1));
        Assert.Equal(before + 3, Columns());
    }

    /// <summary>The kit of panels is small enough to be read in an hour.</summary>
    [Fact]
    public void Kit_HasAtMostTwoThousandLines()
    {
        var lines = ((string[])["", "/Painting", "/Input", "/Widgets"])
            .SelectMany(static room => Directory.EnumerateFiles(Repository.Full($"FractalEngine.Render/Ui{room}"), "U*.cs"))
            .Sum(static file => File.ReadLines(file).Count(static line => line.Trim().Length > 0));
        Assert.InRange(lines, 1, 2000);
    }

    private void Show(Action<UserInterface> widgets, int width = 800)
    {
        _widgets = widgets;
        _ui.Update(width, 600);
    }

    private float FilledWidth() => _ui.Quads.Single(quad =>
        quad.Glyph < 0 && quad.Colour.Blue == (float)UiTheme.Dark.Fill.Blue && quad.Height > 10).Width;

    private void Drag(string text, int right, int pixels)
    {
        var (x, y) = UiText.Find(_ui, text);
        _ui.Handle(new MouseMoved(x + right, y, 0, 0));
        _ui.Handle(new MousePressed(MouseButton.Left, x + right, y, KeyModifiers.None));
        _ui.Handle(new MouseMoved(x + right + pixels, y, pixels, 0));
        _ui.Handle(new MouseReleased(MouseButton.Left, x + right + pixels, y, KeyModifiers.None));
    }
}
