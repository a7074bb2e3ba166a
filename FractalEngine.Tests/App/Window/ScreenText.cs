using FractalEngine.Core.Images;
using FractalEngine.Render.Ui.Overlays;

namespace FractalEngine.Tests.App.Window;

/// <summary>Finds texts in screenshots. Letters are drawn texel by pixel, so that they are found by their shapes.</summary>
internal static class ScreenText
{
    /// <summary>Finds the last place of a text at scale 1, by rows from the top; null where it is not shown.</summary>
    public static (int X, int Y)? Find(PixelImage image, string text)
    {
        var sheet = GlyphAtlas.Shared.Sheets[0];
        var points = new List<(int X, int Y, bool IsInk)>();
        for (var i = 0; i < text.Length; i++)
        {
            var glyph = GlyphAtlas.Shared.GlyphOf(text[i]);
            for (var pixel = 0; pixel < sheet.CellWidth * sheet.CellHeight; pixel++)
            {
                var coverage = sheet.Coverage[(glyph * sheet.CellWidth * sheet.CellHeight) + pixel];
                if (coverage is 0 or > 245)
                {
                    points.Add(((i * sheet.CellWidth) + (pixel % sheet.CellWidth), pixel / sheet.CellWidth, coverage > 0));
                }
            }
        }

        // Ink first: most places fail at once.
        points = [.. points.OrderByDescending(static point => point.IsInk)];
        var width = text.Length * sheet.CellWidth;
        for (var y = image.Height - sheet.CellHeight; y >= 0; y--)
        {
            for (var x = image.Width - width; x >= 0; x--)
            {
                if (points.TrueForAll(point => IsText(image, x + point.X, y + point.Y) == point.IsInk))
                {
                    return (x + (width / 2), y + (sheet.CellHeight / 2));
                }
            }
        }

        return null;
    }

    private static bool IsText(PixelImage image, int x, int y)
    {
        var colour = image[x, y];
        return new[] { UiTheme.Dark.Text, UiTheme.Dark.DimText, UiTheme.Dark.Accent, UiTheme.Dark.Warning }.Any(text =>
            Math.Abs(colour.Red - (255 * text.Red)) < 12 && Math.Abs(colour.Green - (255 * text.Green)) < 12
            && Math.Abs(colour.Blue - (255 * text.Blue)) < 12);
    }
}
