using FractalEngine.Core.Geometry;
using FractalEngine.Render.Ui.Input;
using FractalEngine.Render.Ui.Overlays;
using FractalEngine.Render.Ui.Painting;

namespace FractalEngine.Render.Ui.Widgets;

/// <summary>The tooltip of the widget under the pointer, which covers no row of its panel.</summary>
internal sealed class UiTooltip(UiInput input, UiPainter painter, UiTargets targets, UiAreas areas)
{
    // Characters in a line of a tooltip: beside a panel at least, and at most.
    private const int MinColumns = 24;
    private const int MaxColumns = 60;

    private string? _text;

    // The panel, menu or knob of the widget that it explains.
    private UiRect _owner;

    public bool IsShown => _text is not null;

    public void Begin() => _text = null;

    /// <summary>Explains the last widget while the pointer is over it.</summary>
    public void Explain(string text)
    {
        if (targets.IsHot && !input.IsDown)
        {
            _text = text;
            _owner = targets.RootBounds;
        }
    }

    /// <summary>Prints a text of the last widget. What does not fit is shown while the pointer is over it.</summary>
    public void Print(string text, UiRect rect, Colour colour, double align = 0)
    {
        if (!painter.Print(text, rect, colour, align))
        {
            Explain(text);
        }
    }

    /// <summary>Paints the tooltip, if there is one, before all widgets; a menu or dialog may be in front of the panels.</summary>
    public void Paint(bool isModal)
    {
        if (_text is null)
        {
            return;
        }

        painter.Begin(layer: 2);
        var gap = painter.Gap;
        var (left, right) = Span(isModal);
        var roomBeside = Math.Max(_owner.X - left, right - _owner.Right) - (2 * gap);
        var fitsBeside = roomBeside >= MinColumns * painter.CellWidth;
        var columns = Math.Max(1, Math.Min(MaxColumns, ((fitsBeside ? roomBeside : painter.Bounds.Width) / painter.CellWidth) - 2));
        var lines = TextLines.Wrap(_text, columns).ToArray();
        var width = (lines.Max(static line => line.Length) * painter.CellWidth) + (2 * gap);
        var height = (lines.Length * painter.LineHeight) + (2 * gap);
        var (x, y) = fitsBeside ? PlaceBeside(right, width, height)
            : isModal && _owner.Bottom > painter.Bounds.Height - height ? PlaceBelowPointer(width, height)
            : (Math.Min(_owner.X, painter.Bounds.Width - width), painter.Bounds.Height - height);
        var bounds = new UiRect(x, y, width, height);
        painter.Fill(bounds, painter.Theme.Title, 2);
        painter.Frame(bounds, painter.Theme.Border);
        painter.PrintLines(lines, bounds with { X = x + gap }, painter.Theme.Text);
    }

    /// <summary>
    /// Returns how far a tooltip may reach to the left and right: to the panels on the other side, unless a menu or dialog is in front.
    /// Between narrow columns there is no room, and the tooltip stands at the lower edge of the painter.Bounds.
    /// </summary>
    private (int Left, int Right) Span(bool isModal) => (
        isModal || _owner.X < areas.Free.X ? 0 : areas.Free.X,
        isModal || _owner.Right > areas.Free.Right ? painter.Bounds.Width : areas.Free.Right);

    /// <summary>Places a tooltip beside its panel or menu, of which it covers no row.</summary>
    private (int X, int Y) PlaceBeside(int right, int width, int height)
    {
        var x = _owner.Right + painter.Gap + width <= right ? _owner.Right + painter.Gap : _owner.X - painter.Gap - width;
        return (x, Math.Clamp((int)input.Y - (height / 2), 0, Math.Max(0, painter.Bounds.Height - height)));
    }

    private (int X, int Y) PlaceBelowPointer(int width, int height)
    {
        var x = Math.Max(0, Math.Min((int)input.X + painter.CellWidth, painter.Bounds.Width - width));
        var y = (int)input.Y + painter.LineHeight + painter.Gap;
        return (x, y + height > painter.Bounds.Height ? Math.Max(0, (int)input.Y - height - painter.Gap) : y);
    }
}
