using FractalEngine.Render.Ui.Input;
using FractalEngine.Render.Ui.Overlays;
using FractalEngine.Render.Ui.Painting;
using FractalEngine.Render.Ui.Widgets;
using FractalEngine.Render.Windowing.Keyboard;

namespace FractalEngine.Render.Ui;

/// <summary>The dialog that is open. It takes all input until it is closed, or is not built any more.</summary>
internal sealed class UiDialogs(
    UiInput input, UiPainter painter, UiLayout layout, UiTargets targets, UiFocus focus, UiMenus menus, UiWidgets widgets, UiPanelBody body)
{
    private const int Columns = 76;

    private readonly Dictionary<string, int> _headHeights = [];
    private string? _unbuilt;

    /// <summary>Title of the open dialog; null for none.</summary>
    public string? Opened { get; private set; }

    /// <summary>Whether the dialog or a menu is in front of all panels.</summary>
    public bool IsModal => Opened is not null || menus.Opened is not null;

    public void Begin() => _unbuilt = Opened;

    public void Open(string title)
    {
        menus.Open(null);
        Opened = title;
        // The key that opens it may have a text.
        focus.IgnoresText = true;
    }

    public void Close()
    {
        Opened = null;
        focus.Clear();
    }

    public bool Add(UserInterface ui, string title, Action head, UiPanel panel)
    {
        if (Opened != title)
        {
            return false;
        }

        _unbuilt = null;
        var (padding, bar, frame, theme) = (painter.Padding, painter.RowHeight, painter.Bounds, painter.Theme);
        var width = Math.Min((Columns * painter.CellWidth) + (2 * padding), frame.Width - (2 * painter.Gap));
        var headHeight = _headHeights.GetValueOrDefault(title);
        var height = Math.Min(bar + headHeight + panel.ContentHeight + (4 * padding), frame.Height - (2 * bar));
        var bounds = new UiRect((frame.Width - width) / 2, Math.Max(0, (frame.Height - height) / 2), width, height);
        panel.Bounds = bounds;
        targets.Scope(title, () =>
        {
            targets.BeginRoot("dialog", frame, layer: 2);
            painter.Fill(bounds, theme.Panel);
            var place = bounds with { Height = bar };
            painter.Fill(place, theme.Title);
            painter.Print(title, place.Inset(padding) with { Y = place.Y, Height = bar }, theme.Accent);
            var isClosed = widgets.CloseButton(place);
            _headHeights[title] = layout.Build(bounds.Inset(padding) with { Y = place.Bottom + padding }, 0, head, 1);
            input.BuildsAgain |= _headHeights[title] != headHeight;
            body.Add(ui, panel, bounds with { Y = layout.Y, Height = bounds.Bottom - layout.Y });
            painter.Clip = frame;
            painter.Frame(bounds, theme.Border);
            if (isClosed || (input.IsPressed && !bounds.Contains(input.X, input.Y)))
            {
                Close();
            }
        });
        return Opened == title;
    }

    /// <summary>Closes a dialog that was not built. Escape closes the menu or the dialog, and takes the keyboard from widgets.</summary>
    public void Finish()
    {
        if (_unbuilt is not null)
        {
            Close();
        }

        if ((IsModal || focus.Widget != 0) && input.TakeKey(Key.Escape))
        {
            Opened = menus.Opened is null ? null : Opened;
            // Before the menu, which would commit what is being edited.
            focus.Clear();
            menus.Open(null);
        }
    }
}
