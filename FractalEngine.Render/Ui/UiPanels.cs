using System.Collections.Immutable;
using FractalEngine.Render.Ui.Input;
using FractalEngine.Render.Ui.Overlays;
using FractalEngine.Render.Ui.Painting;
using FractalEngine.Render.Ui.Widgets;

namespace FractalEngine.Render.Ui;

/// <summary>Panels: docked in columns or floating, folded, and dragged from one place to the other.</summary>
internal sealed class UiPanels(UiInput input, UiPainter painter, UiTargets targets, UiAreas areas, UiWidgets widgets, UiPanelBody body)
{
    // Columns of text in a docked panel.
    private const int PanelColumns = 35;

    private int _clickOrder;
    private (UiPanel Panel, double DeltaX, double DeltaY)? _dragged;

    private int PanelWidth => Math.Min(
        (PanelColumns * painter.CellWidth) + (2 * painter.Padding) + body.ScrollBarWidth, (painter.Bounds.Width - painter.Gap) / 2);

    public void Add(UserInterface ui, ImmutableArray<UiPanel> panels, int bottomMargin)
    {
        var free = areas.Free;
        var column = free with { Height = Math.Max(free.Y, free.Bottom - (bottomMargin * painter.RowPitch)) - free.Y };
        foreach (var panel in panels)
        {
            panel.Bounds = default;
        }

        foreach (var dock in (ReadOnlySpan<UiDock>)[UiDock.Left, UiDock.Right])
        {
            AddColumn(ui, [.. panels.Where(panel => panel.IsOpen && panel.Dock == dock)], column, dock == UiDock.Left);
        }

        var margin = 4 * painter.CellWidth;
        foreach (var panel in panels.Where(static panel => panel is { IsOpen: true, Dock: UiDock.Floating }).OrderBy(panel => panel.Order))
        {
            var height = Math.Min(WantedHeight(panel), column.Height);
            // A part of the title always stays in the frame, to move the panel back.
            var minX = margin - PanelWidth;
            var x = (int)Math.Clamp(panel.X * painter.Scale, minX, Math.Max(Math.Max(0, minX), column.Right - margin));
            var y = (int)Math.Clamp(panel.Y * painter.Scale, column.Y, Math.Max(column.Y, column.Bottom - painter.RowHeight));
            AddPanel(ui, panel, new(x, y, PanelWidth, Math.Min(height, Math.Max(painter.RowHeight, column.Bottom - y))));
        }

        Drag();
    }

    private void AddColumn(UserInterface ui, UiPanel[] panels, UiRect column, bool isLeft)
    {
        if (panels.Length == 0)
        {
            return;
        }

        var width = PanelWidth;
        // Not by the height of what is shown, which changes with a selection.
        areas.TakeColumn(isLeft ? width : 0, isLeft ? 0 : width, Array.TrueForAll(panels, static panel => panel.IsFolded));
        var cap = SharedHeight(panels, column.Height - (painter.Gap * (panels.Length - 1)));
        var y = column.Y;
        foreach (var panel in panels)
        {
            var height = Math.Min(WantedHeight(panel), cap);
            AddPanel(ui, panel, new(isLeft ? column.X : column.Right - width, y, width, Math.Max(painter.RowHeight, height)));
            y += height + painter.Gap;
        }
    }

    /// <summary>Returns the largest height of a panel for which all fit a column. Small panels leave their room to large ones.</summary>
    private int SharedHeight(UiPanel[] panels, int height)
    {
        var left = height;
        var count = panels.Length;
        foreach (var wanted in panels.Select(WantedHeight).Order())
        {
            if (wanted * count > left)
            {
                return Math.Max(painter.RowHeight, left / count);
            }

            left -= wanted;
            count--;
        }

        return height;
    }

    private int WantedHeight(UiPanel panel) => painter.RowHeight + (panel.IsFolded ? 0 : panel.ContentHeight + (2 * painter.Padding));

    private void AddPanel(UserInterface ui, UiPanel panel, UiRect bounds)
    {
        panel.Bounds = bounds;
        targets.Scope(panel.Title, () =>
        {
            targets.BeginRoot("panel", bounds, layer: 0);
            painter.Fill(bounds, painter.Theme.Panel);
            AddTitle(panel, bounds with { Height = painter.RowHeight });
            if (!panel.IsFolded)
            {
                body.Add(ui, panel, bounds with { Y = bounds.Y + painter.RowHeight, Height = bounds.Height - painter.RowHeight });
            }

            painter.Clip = painter.Bounds;
            painter.Frame(bounds, painter.Theme.Border);
        });
    }

    private void AddTitle(UiPanel panel, UiRect title)
    {
        var (gap, cell, theme) = (painter.Gap, painter.CellWidth, painter.Theme);
        painter.Fill(title, theme.Title);
        painter.Clip = title;
        var handle = targets.Touch("fold", title with { Width = title.Width - title.Height });
        painter.Print(panel.IsFolded ? "▶" : "▼", title with { X = title.X + gap, Width = cell + gap }, theme.DimText);
        var text = title with { X = title.X + (2 * cell) + gap, Width = title.Width - title.Height - (3 * cell) };
        painter.Print(panel.Title, text, theme.Accent);
        panel.IsFolded ^= handle.IsActivated && _dragged is null;
        if (handle.IsPressed)
        {
            panel.Order = ++_clickOrder;
            input.BuildsAgain = true;
        }

        var moved = Math.Abs(input.X - input.PressX) + Math.Abs(input.Y - input.PressY);
        if (handle.IsHeld && _dragged is null && moved > painter.LineHeight / 2)
        {
            _dragged = (panel, input.PressX - panel.Bounds.X, input.PressY - panel.Bounds.Y);
        }

        panel.IsOpen &= !widgets.CloseButton(title);
    }

    /// <summary>Lets the panel that is dragged follow the pointer, and docks it where it is let go at an edge of the frame.</summary>
    private void Drag()
    {
        if (_dragged is not var (panel, deltaX, deltaY))
        {
            return;
        }

        var x = (input.X - deltaX) / painter.Scale;
        var y = (input.Y - deltaY) / painter.Scale;
        if (panel.Dock != UiDock.Floating || x != panel.X || y != panel.Y)
        {
            panel.X = x;
            panel.Y = y;
            panel.Dock = UiDock.Floating;
            input.BuildsAgain = true;
        }

        if (!input.IsDown)
        {
            var edge = 2 * painter.CellWidth;
            _dragged = null;
            panel.Dock = input.X < edge ? UiDock.Left : input.X >= painter.Bounds.Width - edge ? UiDock.Right : UiDock.Floating;
            input.BuildsAgain = true;
        }
    }
}
