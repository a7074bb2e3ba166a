namespace FractalEngine.Render.Ui.Overlays;

/// <summary>Lays panels out as rectangles in whole pixels: font size, wrapping, columns and stacking.</summary>
/// <param name="atlas">Glyphs of the font.</param>
/// <param name="sheetIndex">Index of the sheet that the glyphs are taken from.</param>
/// <param name="width">Width of the frame in pixels.</param>
/// <param name="height">Height of the frame in pixels.</param>
internal sealed class OverlayLayout(GlyphAtlas atlas, int sheetIndex, int width, int height)
{
    // Lines of text that fit a frame: in 720 rows of pixels the text is 16 pixels high, and it grows with the frame.
    private const double TextRows = 45;
    private const double TextColumns = 78;

    // Stands between the parts of a line, and is dropped where a line breaks.
    private const string PartSeparator = " · ";

    // So dark over a white scene, too, that all texts contrast with it by 4.5:1.
    internal static readonly (float Red, float Green, float Blue, float Alpha) PanelColour = (0.055f, 0.065f, 0.085f, 0.85f);
    private static readonly (float, float, float, float) TrackColour = (1, 1, 1, 0.14f);
    private static readonly (float, float, float, float) BarColour = (0.42f, 0.71f, 0.93f, 1);

    private readonly (int Width, int Height) _frameSize = (width, height);
    private readonly List<(int X, int Y, int Width, int Height)> _panels = [];

    /// <summary>Index of the sheet that the glyphs are taken from.</summary>
    public int SheetIndex { get; } = sheetIndex;

    /// <summary>Rectangles in drawing order.</summary>
    public List<OverlayQuad> Quads { get; } = [];

    /// <summary>Where a click answers something, and what.</summary>
    public List<(UiRect Area, int Answer)> Answers { get; } = [];

    private GlyphSheet Sheet => atlas.Sheets[SheetIndex];

    private int Margin => Sheet.CellHeight / 2;

    private int Padding => Sheet.CellWidth;

    /// <summary>Lays panels out at the preferred font size, or at a smaller one where they do not fit.</summary>
    /// <param name="atlas">Glyphs of the font.</param>
    /// <param name="panels">Panels in the order in which they are stacked, away from their anchor.</param>
    /// <param name="width">Width of the frame in pixels.</param>
    /// <param name="height">Height of the frame in pixels.</param>
    /// <param name="preferredLineHeight">Wanted height of a line in pixels; null for one that follows the frame.</param>
    public static OverlayLayout Create(
        GlyphAtlas atlas, IReadOnlyList<OverlayPanel> panels, int width, int height, int? preferredLineHeight = null)
    {
        var lineHeight = preferredLineHeight ?? 1.2 * Math.Min(height / TextRows, width / TextColumns);
        for (var sheet = atlas.ClosestSheet(lineHeight); ; sheet--)
        {
            var layout = new OverlayLayout(atlas, sheet, width, height);
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

    /// <summary>Returns the colour of a text, sRGB with its opacity.</summary>
    internal static (float Red, float Green, float Blue, float Alpha) ColourOf(OverlayTone tone) => OverlayQuad.Tint(tone switch
    {
        OverlayTone.Dim => UiTheme.Dark.DimText,
        OverlayTone.Accent => UiTheme.Dark.Accent,
        OverlayTone.Warning => UiTheme.Dark.Warning,
        _ => UiTheme.Dark.Text,
    });

    /// <summary>Adds the rectangles of a panel.</summary>
    /// <returns>False when the panel does not fit the frame.</returns>
    private bool AddPanel(OverlayPanel panel)
    {
        var (cellWidth, lineHeight) = (Sheet.CellWidth, Sheet.CellHeight);
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
        var fits = x >= 0 && y >= 0 && x + width <= _frameSize.Width && y + height <= _frameSize.Height;
        // Without room left, a message covers others rather than being cut off.
        y = Math.Max(0, Math.Min(y, _frameSize.Height - height));
        // What lies behind a question may be text, too.
        var ground = panel.IsQuestion ? PanelColour with { Alpha = 1 } : PanelColour;
        Quads.Add(new(x, y, width, height, ground, -1, 0.4f * lineHeight));
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
            AddBar(left, top + (lineHeight / 2), width - (2 * Padding), Math.Max(3, lineHeight / 4), progress);
        }

        return fits;
    }

    private void AddBar(int x, int y, int width, int height, double progress)
    {
        var filled = (int)Math.Round(width * (progress >= 0 ? Math.Min(progress, 1) : 0));
        Quads.Add(new(x, y, width, height, TrackColour, -1, 0.5f * height));
        if (filled > 0)
        {
            Quads.Add(new(x, y, Math.Max(filled, height), height, BarColour, -1, 0.5f * height));
        }
    }

    /// <summary>
    /// Returns the upper left corner of the next panel at an anchor: the first place from there that covers no other panel.
    /// </summary>
    private (int X, int Y) AllocatePosition(OverlayAnchor anchor, int width, int height)
    {
        var gap = Margin / 2;
        var x = anchor is OverlayAnchor.TopLeft or OverlayAnchor.BottomLeft ? Margin : (_frameSize.Width - width) / 2;
        var growsDown = anchor is OverlayAnchor.TopLeft or OverlayAnchor.Centre;
        var y = anchor switch
        {
            OverlayAnchor.TopLeft => Margin,
            OverlayAnchor.Centre => (_frameSize.Height - height) / 2,
            _ => _frameSize.Height - height - Margin,
        };
        // The nearest edges first, so that one pass finds the place.
        var ordered = growsDown
            ? _panels.OrderBy(static panel => panel.Y)
            : _panels.OrderByDescending(static panel => panel.Y + panel.Height);
        foreach (var other in ordered)
        {
            var isBeside = x >= other.X + other.Width || other.X >= x + width;
            if (!isBeside && y < other.Y + other.Height + gap && other.Y < y + height + gap)
            {
                y = growsDown ? other.Y + other.Height + gap : other.Y - height - gap;
            }
        }

        _panels.Add((x, y, width, height));
        return (x, y);
    }

    /// <summary>Breaks lines of one column so that they fit the frame, and those of two where no smaller size would.</summary>
    private List<OverlayLine> Wrap(IReadOnlyList<OverlayLine> lines)
    {
        var columns = Math.Max(8, (_frameSize.Width - (2 * Margin) - (2 * Padding)) / Sheet.CellWidth);
        var second = SheetIndex > 0 ? int.MaxValue : Math.Max(8, columns - FirstColumn(lines));
        return [.. lines.SelectMany(line => line.SecondColumn is { } text
            ? TextLines.Wrap(text, second).Select((row, i) => line with { Text = i == 0 ? line.Text : "", SecondColumn = row })
            : line.Text.Split('\n').SelectMany(row => TextLines.Wrap(row, columns, PartSeparator))
                .Select(row => line with { Text = row }))];
    }

    /// <summary>Returns where the second column begins, in characters; 0 without one.</summary>
    private static int FirstColumn(IEnumerable<OverlayLine> lines) =>
        lines.Where(static row => row.SecondColumn is not null).Select(static row => row.Text.Length + 2).DefaultIfEmpty(0).Max();

    private void AddText(string text, int x, int y, OverlayTone tone)
    {
        for (var i = 0; i < text.Length; i++)
        {
            if (text[i] != ' ')
            {
                Quads.Add(new(
                    x + (i * Sheet.CellWidth), y, Sheet.CellWidth, Sheet.CellHeight, ColourOf(tone), atlas.GlyphOf(text[i]), 0));
            }
        }
    }
}
