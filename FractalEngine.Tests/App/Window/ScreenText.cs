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
        var (ink, paper) = (new List<int>(), new List<int>());
        for (var i = 0; i < text.Length; i++)
        {
            var glyph = GlyphAtlas.Shared.GlyphOf(text[i]);
            for (var pixel = 0; pixel < sheet.CellWidth * sheet.CellHeight; pixel++)
            {
                var coverage = sheet.Coverage[(glyph * sheet.CellWidth * sheet.CellHeight) + pixel];
                if (coverage is 0 or > 245)
                {
                    (coverage > 0 ? ink : paper).Add(
                        (pixel / sheet.CellWidth * image.Width) + (i * sheet.CellWidth) + (pixel % sheet.CellWidth));
                }
            }
        }

        var isText = FindTextPixels(image);
        var width = text.Length * sheet.CellWidth;
        for (var y = image.Height - sheet.CellHeight; y >= 0; y--)
        {
            for (var x = image.Width - width; x >= 0; x--)
            {
                // Ink first: most places fail at once.
                var place = isText.AsSpan((y * image.Width) + x);
                if (AreAll(place, ink, true) && AreAll(place, paper, false))
                {
                    return (x + (width / 2), y + (sheet.CellHeight / 2));
                }
            }
        }

        return null;
    }

    private static bool AreAll(ReadOnlySpan<bool> place, List<int> offsets, bool isText)
    {
        foreach (var offset in offsets)
        {
            if (place[offset] != isText)
            {
                return false;
            }
        }

        return true;
    }

    /// <summary>Tells of each pixel whether it has a colour of texts. A window is looked at many times, so this must be quick.</summary>
    private static bool[] FindTextPixels(PixelImage image)
    {
        var isText = new bool[image.Width * image.Height];
        foreach (var text in new[] { UiTheme.Dark.Text, UiTheme.Dark.DimText, UiTheme.Dark.Accent, UiTheme.Dark.Warning })
        {
            var (red, green, blue) = (255 * text.Red, 255 * text.Green, 255 * text.Blue);
            for (var i = 0; i < isText.Length; i++)
            {
                isText[i] |= Math.Abs(image.Pixels[4 * i] - red) < 12 && Math.Abs(image.Pixels[(4 * i) + 1] - green) < 12
                    && Math.Abs(image.Pixels[(4 * i) + 2] - blue) < 12;
            }
        }

        return isText;
    }
}
