using FractalEngine.Render.Ui.Overlays;

namespace FractalEngine.Render.Ui;

/// <content>Tooltips, which cover no row of their panel.</content>
public sealed partial class UserInterface
{
    // Characters in a line of a tooltip: beside a panel at least, and at most.
    private const int MinTooltipColumns = 24;
    private const int MaxTooltipColumns = 60;

    // The panel, menu or knob of the widget that it explains.
    private UiRect _tooltipOwner;

    /// <summary>Explains the last widget while the pointer is over it.</summary>
    public void Tooltip(string text) => Tooltip(text, _isLastHot);

    private void Tooltip(string text, bool isHot)
    {
        if (isHot && !_input.IsDown)
        {
            _tooltip = text;
            _tooltipOwner = _nextRoots.Find(owner => owner.Root == _root).Bounds;
        }
    }

    /// <summary>Whether a widget is being explained, in front of all texts.</summary>
    internal bool HasTooltip => _tooltip is not null;

    private void DrawTooltip()
    {
        if (_tooltip is null)
        {
            return;
        }

        _layer = 2;
        _clip = new(0, 0, _width, _height);
        var (left, right) = TooltipSpan();
        var roomBeside = Math.Max(_tooltipOwner.X - left, right - _tooltipOwner.Right) - (2 * Gap);
        var fitsBeside = roomBeside >= MinTooltipColumns * CellWidth;
        var columns = Math.Max(1, Math.Min(MaxTooltipColumns, ((fitsBeside ? roomBeside : _width) / CellWidth) - 2));
        var lines = Wrap(_tooltip, columns).ToArray();
        var width = (lines.Max(static line => line.Length) * CellWidth) + (2 * Gap);
        var height = (lines.Length * LineHeight) + (2 * Gap);
        var (x, y) = fitsBeside ? PlaceBeside(_tooltipOwner, right, width, height)
            : IsModal && _tooltipOwner.Bottom > _height - height ? PlaceBelowPointer(width, height)
            : (Math.Min(_tooltipOwner.X, _width - width), _height - height);
        var bounds = new UiRect(x, y, width, height);
        Fill(bounds, Theme.Title, 2);
        Frame(bounds, Theme.Border);
        for (var i = 0; i < lines.Length; i++)
        {
            Print(lines[i], new(x + Gap, y + Gap + (i * LineHeight), width, LineHeight), Theme.Text);
        }
    }

    /// <summary>
    /// Returns how far a tooltip may reach to the left and right: to the panels on the other side, unless a menu or dialog is in front.
    /// Between narrow columns there is no room, and the tooltip stands at the lower edge of the frame.
    /// </summary>
    private (int Left, int Right) TooltipSpan() => IsModal
        ? (0, _width)
        : (_tooltipOwner.X >= FreeArea.X ? FreeArea.X : 0, _tooltipOwner.Right <= FreeArea.Right ? FreeArea.Right : _width);

    /// <summary>Places a tooltip beside its panel or menu, of which it covers no row.</summary>
    private (int X, int Y) PlaceBeside(UiRect owner, int right, int width, int height)
    {
        var x = owner.Right + Gap + width <= right ? owner.Right + Gap : owner.X - Gap - width;
        return (x, Math.Clamp((int)_input.Y - (height / 2), 0, Math.Max(0, _height - height)));
    }

    private (int X, int Y) PlaceBelowPointer(int width, int height)
    {
        var x = Math.Max(0, Math.Min((int)_input.X + CellWidth, _width - width));
        var y = (int)_input.Y + LineHeight + Gap;
        return (x, y + height > _height ? Math.Max(0, (int)_input.Y - height - Gap) : y);
    }
}
