using FractalEngine.Core.Geometry;
using FractalEngine.Render.Ui.Overlays;

namespace FractalEngine.Render.Ui;

/// <content>Rectangles, frames and texts.</content>
public sealed partial class UserInterface
{
    // Half a pixel: the shader smooths edges across one, which whole pixels need not.
    private const float SquareCorner = 0.5f;

    private static (float, float, float, float) Tint(Colour colour, float opacity = 1) =>
        ((float)colour.Red, (float)colour.Green, (float)colour.Blue, opacity);

    private void Fill(UiRect rect, Colour colour, float radius = SquareCorner, float opacity = 1)
    {
        var visible = rect.Intersect(_clip);
        if (visible is { Width: > 0, Height: > 0 })
        {
            _layers[_layer].Add(new(
                visible.X, visible.Y, visible.Width, visible.Height, Tint(colour, opacity), -1,
                visible == rect ? radius : SquareCorner));
        }
    }

    private void Frame(UiRect rect, Colour colour)
    {
        var line = Math.Max(1, LineHeight / 16);
        Fill(new(rect.X, rect.Y, rect.Width, line), colour);
        Fill(new(rect.X, rect.Bottom - line, rect.Width, line), colour);
        Fill(new(rect.X, rect.Y, line, rect.Height), colour);
        Fill(new(rect.Right - line, rect.Y, line, rect.Height), colour);
    }

    /// <summary>Draws text into a rectangle, in its vertical middle. What does not fit ends in an ellipsis.</summary>
    /// <returns>False when the text did not fit.</returns>
    private bool Print(string text, UiRect rect, Colour colour, UiAlign align = UiAlign.Left)
    {
        var columns = rect.Width / CellWidth;
        var fits = text.Length <= columns;
        if (!fits)
        {
            text = columns <= 0 ? "" : text[..(columns - 1)] + "…";
        }

        var free = rect.Width - (text.Length * CellWidth);
        var x = rect.X + (align == UiAlign.Left ? 0 : align == UiAlign.Right ? free : free / 2);
        var y = rect.Y + ((rect.Height - LineHeight) / 2);
        if (y < _clip.Y || y + LineHeight > _clip.Bottom)
        {
            return fits;
        }

        var tint = Tint(colour);
        for (var i = 0; i < text.Length; i++)
        {
            var left = x + (i * CellWidth);
            if (text[i] != ' ' && left >= _clip.X && left + CellWidth <= _clip.Right)
            {
                _layers[_layer].Add(new(left, y, CellWidth, LineHeight, tint, GlyphAtlas.Shared.GlyphOf(text[i]), 0));
            }
        }

        return fits;
    }

    private void DrawFocus(UiTouch touch, UiRect rect)
    {
        if (_focus == touch.Id)
        {
            Frame(rect, Theme.Focus);
        }
    }

    private static IEnumerable<string> Wrap(string line, int columns)
    {
        while (line.Length > columns)
        {
            var blank = line.LastIndexOf(' ', columns);
            var length = blank > 0 ? blank : columns;
            yield return line[..length];
            line = line[length..].TrimStart();
        }

        yield return line;
    }
}
