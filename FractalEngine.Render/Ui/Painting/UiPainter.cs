using FractalEngine.Core.Geometry;
using FractalEngine.Render.Ui.Overlays;

namespace FractalEngine.Render.Ui.Painting;

/// <summary>Paints the rectangles and texts of widgets in three layers, from the back to the front, as large as the text is.</summary>
internal sealed class UiPainter
{
    // Half a pixel: the shader smooths edges across one, which whole pixels need not.
    private const float SquareCorner = 0.5f;

    private readonly List<OverlayQuad>[] _layers = [[], [], []];
    private int _layer;

    public UiPainter() => Scale = 1;

    public UiTheme Theme { get; set; } = UiTheme.Dark;

    public double Scale
    {
        get;
        set
        {
            field = Math.Clamp(value, 0.5, 4);
            Sheet = GlyphAtlas.Shared.Sheets[GlyphAtlas.Shared.ClosestSheet(16 * field)];
        }
    }

    /// <summary>Sheet that the glyphs are taken from.</summary>
    public GlyphSheet Sheet { get; set; } = GlyphAtlas.Shared.Sheets[0];

    /// <summary>The whole frame, from its upper left corner at 0.</summary>
    public UiRect Bounds { get; set; }

    /// <summary>What lies outside is not painted.</summary>
    public UiRect Clip { get; set; }

    public int CellWidth => Sheet.CellWidth;

    public int LineHeight => Sheet.CellHeight;

    /// <summary>Height of a row of widgets, without the gap below.</summary>
    public int RowHeight => LineHeight + (2 * Gap);

    /// <summary>Height of a row with the gap below.</summary>
    public int RowPitch => RowHeight + Gap;

    public int Gap => Math.Max(1, LineHeight / 8);

    public int Padding => Math.Max(3, CellWidth * 3 / 4);

    /// <summary>Begins anew, with nothing painted.</summary>
    public void Clear()
    {
        Array.ForEach(_layers, static layer => layer.Clear());
        Begin(0);
    }

    /// <summary>Paints into a layer from now on, anywhere in the frame.</summary>
    public void Begin(int layer)
    {
        _layer = layer;
        Clip = Bounds;
    }

    /// <summary>Returns what was painted, in drawing order.</summary>
    public List<OverlayQuad> ToQuads() => [.. _layers.SelectMany(static layer => layer)];

    public void Fill(UiRect rect, Colour colour, float radius = SquareCorner, double opacity = 1)
    {
        var visible = rect.Intersect(Clip);
        if (visible is { Width: > 0, Height: > 0 })
        {
            var corner = visible == rect ? radius : SquareCorner;
            var tint = OverlayQuad.Tint(colour) with { Alpha = (float)opacity };
            _layers[_layer].Add(new(visible.X, visible.Y, visible.Width, visible.Height, tint, -1, corner));
        }
    }

    public void Frame(UiRect rect, Colour colour)
    {
        var line = Math.Max(1, LineHeight / 16);
        Fill(new(rect.X, rect.Y, rect.Width, line), colour);
        Fill(new(rect.X, rect.Bottom - line, rect.Width, line), colour);
        Fill(new(rect.X, rect.Y, line, rect.Height), colour);
        Fill(new(rect.Right - line, rect.Y, line, rect.Height), colour);
    }

    /// <summary>Frames a widget that has the keyboard.</summary>
    public void FrameFocus(UiRect rect, bool hasFocus)
    {
        if (hasFocus)
        {
            Frame(rect, Theme.Focus);
        }
    }

    /// <summary>Prints text in the middle of a rectangle's height, after a share of the free width. An ellipsis ends what is cut.</summary>
    /// <returns>False when the text did not fit.</returns>
    public bool Print(string text, UiRect rect, Colour colour, double align = 0)
    {
        var columns = rect.Width / CellWidth;
        var fits = text.Length <= columns;
        if (!fits)
        {
            text = columns <= 0 ? "" : text[..(columns - 1)] + "…";
        }

        var free = rect.Width - (text.Length * CellWidth);
        var x = rect.X + (int)(free * align);
        var y = rect.Y + ((rect.Height - LineHeight) / 2);
        if (y < Clip.Y || y + LineHeight > Clip.Bottom)
        {
            return fits;
        }

        var tint = OverlayQuad.Tint(colour);
        for (var i = 0; i < text.Length; i++)
        {
            var left = x + (i * CellWidth);
            if (text[i] != ' ' && left >= Clip.X && left + CellWidth <= Clip.Right)
            {
                _layers[_layer].Add(new(left, y, CellWidth, LineHeight, tint, GlyphAtlas.Shared.GlyphOf(text[i]), 0));
            }
        }

        return fits;
    }

    /// <summary>Prints lines below each other, from the upper edge of a rectangle.</summary>
    public void PrintLines(string[] lines, UiRect rect, Colour colour)
    {
        for (var i = 0; i < lines.Length; i++)
        {
            Print(lines[i], new(rect.X, rect.Y + Gap + (i * LineHeight), rect.Width, LineHeight), colour);
        }
    }
}
