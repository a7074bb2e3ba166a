using System.Collections.Immutable;
using FractalEngine.Render.Ui.Overlays;

namespace FractalEngine.Render.Ui;

/// <content>Panels: docked in columns or floating, folded and scrolled.</content>
public sealed partial class UserInterface
{
    // Columns of text in a docked panel.
    private const int PanelColumns = 35;

    private int _clickOrder;
    private UiRect? _scrolledRect;
    private (UiPanel Panel, double DeltaX, double DeltaY)? _dragged;

    private int TitleHeight => RowHeight;

    private int PanelWidth => Math.Min((PanelColumns * CellWidth) + (2 * Padding) + ScrollBarWidth, (_width - Gap) / 2);

    private int ScrollBarWidth => Math.Max(6, CellWidth * 3 / 4);

    /// <summary>Adds panels: the docked ones in columns that share the height of the frame, the floating ones in front.</summary>
    /// <param name="panels">Panels in their order within a column; closed ones are left out.</param>
    /// <param name="bottomMargin">Rows of text that stay free at the lower edge of the frame.</param>
    public void Panels(ImmutableArray<UiPanel> panels, int bottomMargin = 0)
    {
        var bottom = Math.Max(FreeArea.Y, FreeArea.Bottom - (bottomMargin * RowPitch));
        var column = new UiRect(FreeArea.X, FreeArea.Y, FreeArea.Width, bottom - FreeArea.Y);
        foreach (var panel in panels)
        {
            panel.Bounds = default;
        }

        foreach (var dock in (ReadOnlySpan<UiDock>)[UiDock.Left, UiDock.Right])
        {
            var docked = panels.Where(panel => panel.IsOpen && panel.Dock == dock).ToArray();
            if (docked.Length > 0)
            {
                AddColumn(docked, column, dock);
            }
        }

        foreach (var panel in panels.Where(static panel => panel is { IsOpen: true, Dock: UiDock.Floating }).OrderBy(panel => panel.Order))
        {
            var height = Math.Min(WantedHeight(panel), column.Height);
            // A part of the title always stays in the frame, to move the panel back.
            var minX = (4 * CellWidth) - PanelWidth;
            var x = (int)Math.Clamp(panel.X * Scale, minX, Math.Max(Math.Max(0, minX), column.Right - (4 * CellWidth)));
            var y = (int)Math.Clamp(panel.Y * Scale, column.Y, Math.Max(column.Y, column.Bottom - TitleHeight));
            AddPanel(panel, new(x, y, PanelWidth, Math.Min(height, Math.Max(TitleHeight, column.Bottom - y))));
        }

        EndDrag();
    }

    private void AddColumn(UiPanel[] panels, UiRect column, UiDock dock)
    {
        var width = PanelWidth;
        var x = dock == UiDock.Left ? column.X : column.Right - width;
        var free = FreeArea;
        FreeArea = dock == UiDock.Left ? free with { X = x + width, Width = free.Width - width } : free with { Width = free.Width - width };
        var cap = SharedHeight(panels, column.Height - (Gap * (panels.Length - 1)));
        var y = column.Y;
        foreach (var panel in panels)
        {
            var height = Math.Min(WantedHeight(panel), cap);
            AddPanel(panel, new(x, y, width, Math.Max(TitleHeight, height)));
            y += height + Gap;
        }

        // Not by the height of what is shown, which changes with a selection.
        if (panels.Any(static panel => !panel.IsFolded))
        {
            _viewArea = new(FreeArea.X, 0, FreeArea.Width, _height);
        }
    }

    /// <summary>
    /// Returns the largest height of a panel for which all panels fit a column. Small panels leave their room to large ones.
    /// </summary>
    private int SharedHeight(UiPanel[] panels, int height)
    {
        var left = height;
        var count = panels.Length;
        foreach (var wanted in panels.Select(WantedHeight).Order())
        {
            if (wanted * count > left)
            {
                return Math.Max(TitleHeight, left / count);
            }

            left -= wanted;
            count--;
        }

        return height;
    }

    private int WantedHeight(UiPanel panel) => TitleHeight + (panel.IsFolded ? 0 : panel.ContentHeight + (2 * Padding));

    private void AddPanel(UiPanel panel, UiRect bounds)
    {
        panel.Bounds = bounds;
        Scope(panel.Title, () =>
        {
            BeginRoot(IdOf("panel"), bounds, layer: 0);
            Fill(bounds, Theme.Panel);
            AddTitle(panel, bounds with { Height = TitleHeight });
            if (!panel.IsFolded)
            {
                AddBody(panel, new(bounds.X, bounds.Y + TitleHeight, bounds.Width, bounds.Height - TitleHeight));
            }

            _clip = new(0, 0, _width, _height);
            Frame(bounds, Theme.Border);
        });
    }

    private void AddTitle(UiPanel panel, UiRect title)
    {
        Fill(title, Theme.Title);
        _clip = title;
        var button = title.Height;
        var fold = new UiRect(title.X, title.Y, title.Width - button, title.Height);
        var handle = Touch(IdOf("fold"), fold, takesFocus: true);
        Print(panel.IsFolded ? "▶" : "▼", new(title.X + Gap, title.Y, CellWidth + Gap, title.Height), Theme.DimText);
        var text = new UiRect(title.X + (2 * CellWidth) + Gap, title.Y, title.Width - button - (3 * CellWidth), title.Height);
        Print(panel.Title, text, Theme.Accent);
        if (handle.IsActivated && _dragged is null)
        {
            panel.IsFolded = !panel.IsFolded;
            _buildsAgain = true;
        }

        if (handle.IsPressed)
        {
            panel.Order = ++_clickOrder;
            _buildsAgain = true;
        }

        if (handle.IsHeld && _dragged is null && Math.Abs(_input.X - _pressX) + Math.Abs(_input.Y - _pressY) > LineHeight / 2)
        {
            _dragged = (panel, _pressX - panel.Bounds.X, _pressY - panel.Bounds.Y);
        }

        if (AddCloseButton(title))
        {
            panel.IsOpen = false;
        }
    }

    /// <summary>Adds the × at the right end of a title.</summary>
    private bool AddCloseButton(UiRect title)
    {
        var place = title with { X = title.Right - title.Height, Width = title.Height };
        var touch = Touch(IdOf("close"), place, takesFocus: false);
        Print("×", place, touch.IsHot ? Theme.Accent : Theme.DimText, UiAlign.Middle);
        return touch.IsActivated;
    }

    /// <summary>Lets the panel that is dragged follow the pointer, and docks it where it is let go at an edge of the frame.</summary>
    private void EndDrag()
    {
        if (_dragged is not var (panel, deltaX, deltaY))
        {
            return;
        }

        var x = (_input.X - deltaX) / Scale;
        var y = (_input.Y - deltaY) / Scale;
        if (panel.Dock != UiDock.Floating || x != panel.X || y != panel.Y)
        {
            panel.X = x;
            panel.Y = y;
            panel.Dock = UiDock.Floating;
            _buildsAgain = true;
        }

        if (!_input.IsDown)
        {
            _dragged = null;
            panel.Dock = _input.X < 2 * CellWidth ? UiDock.Left : _input.X >= _width - (2 * CellWidth) ? UiDock.Right : UiDock.Floating;
            _buildsAgain = true;
        }
    }

    private void AddBody(UiPanel panel, UiRect body)
    {
        var view = new UiRect(body.X, body.Y + Padding, body.Width, Math.Max(0, body.Height - (2 * Padding)));
        var hidden = Math.Max(0, panel.ContentHeight - view.Height);
        if (hidden > 0)
        {
            // No row is cut in two.
            view = view with { Height = Math.Max(RowHeight, (((view.Height + Gap) / RowPitch) * RowPitch) - Gap) };
            hidden = panel.ContentHeight - view.Height;
        }

        var lastRow = (hidden + RowPitch - 1) / RowPitch;
        if (_input.Wheel != 0 && _hoverRoot == _root && body.Contains(_input.X, _input.Y) && hidden > 0)
        {
            panel.ScrolledRows -= (int)Math.Round(3 * _input.Wheel);
            _input.Wheel = 0;
            _buildsAgain = true;
        }

        _clip = body;
        if (hidden > 0)
        {
            AddScrollBar(panel, new(body.Right - ScrollBarWidth, body.Y, ScrollBarWidth, body.Height), lastRow, view.Height);
        }

        panel.ScrolledRows = Math.Clamp(panel.ScrolledRows, 0, lastRow);
        _clip = body with { Y = view.Y - Gap, Height = view.Height + (2 * Gap) };
        _area = new(body.X + Padding, view.Y, body.Width - (2 * Padding) - (hidden > 0 ? ScrollBarWidth : 0), view.Height);
        _cursorY = view.Y - (panel.ScrolledRows * RowPitch);
        var top = _cursorY;
        Row(1);
        panel.Build(this);
        FinishRow();
        var height = Math.Max(0, _cursorY - top - Gap);
        if (height != panel.ContentHeight)
        {
            panel.ContentHeight = height;
            _buildsAgain = true;
        }

        ScrollToFocus(panel, view);
    }

    private void AddScrollBar(UiPanel panel, UiRect track, int lastRow, int viewHeight)
    {
        var handle = Touch(IdOf("scroll"), track, takesFocus: false);
        var length = Math.Max(LineHeight, track.Height * viewHeight / (viewHeight + (lastRow * RowPitch)));
        if (handle.IsHeld && track.Height > length)
        {
            var fraction = (_input.Y - track.Y - (0.5 * length)) / (track.Height - length);
            var row = (int)Math.Round(Math.Clamp(fraction, 0, 1) * lastRow);
            _buildsAgain |= row != panel.ScrolledRows;
            panel.ScrolledRows = row;
        }

        var position = (track.Height - length) * Math.Min(panel.ScrolledRows, lastRow) / Math.Max(1, lastRow);
        Fill(track, Theme.Field);
        var colour = handle.IsHot || handle.IsHeld ? Theme.DimText : Theme.Border;
        Fill(new(track.X + 1, track.Y + position, track.Width - 2, length), colour, 3);
    }

    /// <summary>Scrolls the panel that is being built until the next rows are in view.</summary>
    /// <param name="rows">Number of rows, of which the first counts most.</param>
    public void ScrollHere(int rows)
    {
        FinishRow();
        _scrollTo = -1;
        _scrolledRect = new(_area.X, _cursorY, _area.Width, Math.Min((rows * RowPitch) - Gap, _area.Height));
    }

    private void ScrollToFocus(UiPanel panel, UiRect view)
    {
        if (_scrollTo == 0 || _scrolledRect is not { } rect)
        {
            return;
        }

        var above = view.Y - rect.Y;
        var below = rect.Bottom - view.Bottom;
        panel.ScrolledRows += above > 0 ? -((above + RowPitch - 1) / RowPitch) : below > 0 ? (below + RowPitch - 1) / RowPitch : 0;
        _scrollTo = 0;
        _scrolledRect = null;
        _buildsAgain = true;
    }
}
