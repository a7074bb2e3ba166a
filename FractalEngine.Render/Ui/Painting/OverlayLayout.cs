using FractalEngine.Core.Geometry;
using FractalEngine.Render.Ui.Overlays;

namespace FractalEngine.Render.Ui.Painting;

/// <summary>Lays panels out in whole pixels: font size, wrapping, columns and stacking. A painter of its own paints them.</summary>
/// <param name="area">The part of the frame that the panels stand in, in pixels.</param>
/// <param name="sheetIndex">Index of the sheet that the glyphs are taken from.</param>
internal sealed class OverlayLayout(UiRect area, int sheetIndex)
{
    // Lines of text that fit a frame: in 720 rows of pixels the text is 16 pixels high, and it grows with the frame.
    private const double TextRows = 45;
    private const double TextColumns = 78;

    // Stands between the parts of a line, and is dropped where a line breaks.
    private const string PartSeparator = " · ";

    // So dark over a white scene, too, that all texts contrast with it by 4.5:1.
    internal const double PanelOpacity = 0.85;
    internal static readonly Colour PanelColour = new(0.055, 0.065, 0.085);
    private const double TrackOpacity = 0.14;
    private static readonly Colour BarColour = new(0.42, 0.71, 0.93);

    // What has no room is cut off by the frame alone.
    private readonly UiPainter _painter = new() { Sheet = GlyphAtlas.Shared.Sheets[sheetIndex], Clip = UiRect.Everything };
    private readonly List<UiRect> _panels = [];

    /// <summary>Index of the sheet that the glyphs are taken from.</summary>
    public int SheetIndex { get; } = sheetIndex;

    /// <summary>Rectangles in drawing order.</summary>
    public List<OverlayQuad> Quads => _painter.ToQuads();

    /// <summary>Where a click answers something, and what.</summary>
    public List<(UiRect Area, int Answer)> Answers { get; } = [];

    private int Margin => _painter.LineHeight / 2;

    private int Padding => _painter.CellWidth;

    /// <summary>Lays panels out at the preferred font size, or at a smaller one where they do not fit.</summary>
    /// <param name="panels">Panels in the order in which they are stacked, away from their anchor.</param>
    /// <param name="area">The part of the frame that the panels stand in, in pixels.</param>
    /// <param name="preferredLineHeight">Wanted height of a line in pixels; null for one that follows the area.</param>
    public static OverlayLayout Create(IReadOnlyList<OverlayPanel> panels, UiRect area, int? preferredLineHeight = null)
    {
        var lineHeight = preferredLineHeight ?? 1.2 * Math.Min(area.Height / TextRows, area.Width / TextColumns);
        for (var sheet = GlyphAtlas.Shared.ClosestSheet(lineHeight); ; sheet--)
        {
            var layout = new OverlayLayout(area, sheet);
            var fits = true;
            foreach (var panel in panels)
            {
                fits &= layout.AddPanel(panel);
            }

            // A panel that is too high even at the smallest size is cut off by the edge of the frame.
            if (fits || sheet == 0)
            {
                return layout;
            }
        }
    }

    /// <summary>Returns the colour of a text.</summary>
    internal static Colour ColourOf(OverlayTone tone) => tone switch
    {
        OverlayTone.Dim => UiTheme.Dark.DimText,
        OverlayTone.Accent => UiTheme.Dark.Accent,
        OverlayTone.Warning => UiTheme.Dark.Warning,
        _ => UiTheme.Dark.Text,
    };

    /// <summary>Paints a panel in the next free place.</summary>
    /// <returns>False when the panel does not fit the area.</returns>
    private bool AddPanel(OverlayPanel panel)
    {
        var (cellWidth, lineHeight) = (_painter.CellWidth, _painter.LineHeight);
        var lines = Wrap(panel.Lines);
        var title = panel.Title is null ? [] : Wrap([new(panel.Title)]);
        var firstColumn = FirstColumn(lines);
        var columns = lines.Select(row => row.SecondColumn is null ? row.Text.Length : firstColumn + row.SecondColumn.Length)
            .Concat(title.Select(row => row.Text.Length)).Append(panel.Progress is null ? 0 : 32).Max();
        var width = (columns * cellWidth) + (2 * Padding);
        var titleHeight = title.Count == 0 ? 0 : (title.Count * lineHeight) + (lineHeight / 3);
        var barHeight = panel.Progress is null ? 0 : lineHeight;
        var height = titleHeight + (lines.Count * lineHeight) + barHeight + (2 * Padding * 3 / 4);

        var (x, y) = AllocatePosition(panel.Anchor, width, height);
        var fits = x >= area.X && y >= area.Y && x + width <= area.Right && y + height <= area.Bottom;
        // Without room left, a message covers others rather than being cut off.
        y = Math.Max(area.Y, Math.Min(y, area.Bottom - height));
        // What lies behind a question may be text, too.
        _painter.Fill(new(x, y, width, height), PanelColour, 0.4f * lineHeight, panel.IsQuestion ? 1 : PanelOpacity);
        var left = x + Padding;
        var top = y + (Padding * 3 / 4);
        for (var i = 0; i < title.Count; i++)
        {
            AddText(title[i].Text, left, top + (i * lineHeight), OverlayTone.Accent);
        }

        top += titleHeight;

        foreach (var row in lines)
        {
            if (row.Answer is { } answer)
            {
                Answers.Add((new(x, top, width, lineHeight), answer));
            }

            AddText(row.Text, left, top, row.SecondColumn is null ? row.Tone : OverlayTone.Accent);
            AddText(row.SecondColumn ?? "", left + (firstColumn * cellWidth), top, row.Tone);
            top += lineHeight;
        }

        if (panel.Progress is { } progress)
        {
            AddBar(new(left, top + (lineHeight / 2), width - (2 * Padding), Math.Max(3, lineHeight / 4)), progress);
        }

        return fits;
    }

    private void AddBar(UiRect track, double progress)
    {
        var filled = (int)Math.Round(track.Width * (progress >= 0 ? Math.Min(progress, 1) : 0));
        _painter.Fill(track, Colour.White, 0.5f * track.Height, TrackOpacity);
        if (filled > 0)
        {
            _painter.Fill(track with { Width = Math.Max(filled, track.Height) }, BarColour, 0.5f * track.Height);
        }
    }

    /// <summary>
    /// Returns the upper left corner of the next panel at an anchor: the first place from there that covers no other panel.
    /// </summary>
    private (int X, int Y) AllocatePosition(OverlayAnchor anchor, int width, int height)
    {
        var gap = Margin / 2;
        var x = area.X + (anchor is OverlayAnchor.TopLeft or OverlayAnchor.BottomLeft ? Margin : (area.Width - width) / 2);
        var growsDown = anchor is OverlayAnchor.TopLeft or OverlayAnchor.Centre;
        var y = anchor switch
        {
            OverlayAnchor.TopLeft => area.Y + Margin,
            OverlayAnchor.Centre => area.Y + ((area.Height - height) / 2),
            _ => area.Bottom - height - Margin,
        };
        // The nearest edges first, so that one pass finds the place.
        var ordered = growsDown
            ? _panels.OrderBy(static panel => panel.Y)
            : _panels.OrderByDescending(static panel => panel.Bottom);
        foreach (var other in ordered)
        {
            var isBeside = x >= other.Right || other.X >= x + width;
            if (!isBeside && y < other.Bottom + gap && other.Y < y + height + gap)
            {
                y = growsDown ? other.Bottom + gap : other.Y - height - gap;
            }
        }

        _panels.Add(new(x, y, width, height));
        return (x, y);
    }

    /// <summary>Breaks lines of one column so that they fit the frame, and those of two where no smaller size would.</summary>
    private List<OverlayLine> Wrap(IReadOnlyList<OverlayLine> lines)
    {
        var columns = Math.Max(8, (area.Width - (2 * Margin) - (2 * Padding)) / _painter.CellWidth);
        var second = SheetIndex > 0 ? int.MaxValue : Math.Max(8, columns - FirstColumn(lines));
        return [.. lines.SelectMany(line => line.SecondColumn is { } text
            ? TextLines.Wrap(text, second).Select((row, i) => line with { Text = i == 0 ? line.Text : "", SecondColumn = row })
            : line.Text.Split('\n').SelectMany(row => TextLines.Wrap(row, columns, PartSeparator))
                .Select(row => line with { Text = row }))];
    }

    /// <summary>Returns where the second column begins, in characters; 0 without one.</summary>
    private static int FirstColumn(IEnumerable<OverlayLine> lines) =>
        lines.Where(static row => row.SecondColumn is not null).Select(static row => row.Text.Length + 2).DefaultIfEmpty(0).Max();

    private void AddText(string text, int x, int y, OverlayTone tone) =>
        _painter.Print(text, new(x, y, text.Length * _painter.CellWidth, _painter.LineHeight), ColourOf(tone));
}
