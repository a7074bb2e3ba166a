using FractalEngine.Render.Ui.Input;
using FractalEngine.Render.Ui.Overlays;
using FractalEngine.Render.Ui.Painting;

namespace FractalEngine.Render.Ui;

/// <summary>The widgets of a panel, which scroll where they are higher than it.</summary>
internal sealed class UiPanelBody(UiInput input, UiPainter painter, UiLayout layout, UiTargets targets, UiFocus focus)
{
    private const int RowsPerNotch = 3;

    // What touchpads and fine wheels have turned that is less than a row.
    private double _turnedRows;

    public int ScrollBarWidth => Math.Max(6, painter.CellWidth * 3 / 4);

    public void Add(UserInterface ui, UiPanel panel, UiRect body)
    {
        var (gap, padding, pitch) = (painter.Gap, painter.Padding, painter.RowPitch);
        var view = new UiRect(body.X + padding, body.Y + padding, body.Width - (2 * padding), Math.Max(0, body.Height - (2 * padding)));
        var hidden = Math.Max(0, panel.ContentHeight - view.Height);
        if (hidden > 0)
        {
            // No row is cut in two.
            view = view with { Height = Math.Max(pitch, (view.Height + gap) / pitch * pitch) - gap };
            hidden = panel.ContentHeight - view.Height;
        }

        var lastRow = (hidden + pitch - 1) / pitch;
        if (input.Wheel != 0 && targets.IsRootHot && body.Contains(input.X, input.Y) && hidden > 0)
        {
            _turnedRows += RowsPerNotch * input.Wheel;
            panel.ScrolledRows -= (int)_turnedRows;
            _turnedRows %= 1;
            input.Wheel = 0;
            input.BuildsAgain = true;
        }

        painter.Clip = body;
        if (hidden > 0)
        {
            AddScrollBar(panel, body with { X = body.Right - ScrollBarWidth, Width = ScrollBarWidth }, lastRow, view.Height);
            view = view with { Width = view.Width - ScrollBarWidth };
        }

        panel.ScrolledRows = Math.Clamp(panel.ScrolledRows, 0, lastRow);
        painter.Clip = body with { Y = view.Y - gap, Height = view.Height + (2 * gap) };
        var height = Math.Max(0, layout.Build(view, panel.ScrolledRows * pitch, () => panel.Build(ui), 1) - gap);
        input.BuildsAgain |= height != panel.ContentHeight;
        panel.ContentHeight = height;
        ScrollToRevealed(panel, view);
    }

    /// <summary>Scrolls the panel that is being built until the next rows are in view.</summary>
    public void ScrollHere(int rows)
    {
        layout.FinishRow();
        var height = (rows * painter.RowPitch) - painter.Gap;
        focus.Reveal(layout.Area with { Y = layout.Y, Height = Math.Min(height, layout.Area.Height) });
    }

    private void AddScrollBar(UiPanel panel, UiRect track, int lastRow, int viewHeight)
    {
        var handle = targets.Touch("scroll", track, takesFocus: false);
        var length = Math.Max(painter.LineHeight, track.Height * viewHeight / (viewHeight + (lastRow * painter.RowPitch)));
        if (handle.IsHeld && track.Height > length)
        {
            var fraction = (input.Y - track.Y - (0.5 * length)) / (track.Height - length);
            var row = (int)Math.Round(Math.Clamp(fraction, 0, 1) * lastRow);
            input.BuildsAgain |= row != panel.ScrolledRows;
            panel.ScrolledRows = row;
        }

        var position = (track.Height - length) * Math.Min(panel.ScrolledRows, lastRow) / Math.Max(1, lastRow);
        painter.Fill(track, painter.Theme.Field);
        var colour = handle.IsHot || handle.IsHeld ? painter.Theme.DimText : painter.Theme.Border;
        painter.Fill(new(track.X + 1, track.Y + position, track.Width - 2, length), colour, 3);
    }

    private void ScrollToRevealed(UiPanel panel, UiRect view)
    {
        if (focus.Revealed is { } rect)
        {
            var pitch = painter.RowPitch;
            var above = view.Y - rect.Y;
            var below = rect.Bottom - view.Bottom;
            panel.ScrolledRows += above > 0 ? -((above + pitch - 1) / pitch) : below > 0 ? (below + pitch - 1) / pitch : 0;
            focus.Revealed = null;
            input.BuildsAgain = true;
        }
    }
}
