using FractalEngine.Core.Geometry;
using FractalEngine.Core.Images;
using FractalEngine.Render;
using FractalEngine.Render.Ui.Overlays;
using FractalEngine.Render.Ui.Painting;

namespace FractalEngine.Tests.Render.Ui;

[Collection(GlTests.Name)]
public sealed class OverlayTests
{
    private static readonly GlyphAtlas Atlas = GlyphAtlas.Load();

    [Fact]
    public void Atlas_EverySupportedCharacter_HasAGlyphOfItsOwn()
    {
        const string Supported = "ABCXYZabcxyz0123456789!\"#$%&'()*+,-./:;<=>?@[\\]^_`{|}~äöüßéñÅ·×°µ≤…–→²³⁵⁸";
        var question = Atlas.GlyphOf('?');
        Assert.All(Supported.Where(character => character != '?'), character => Assert.NotEqual(question, Atlas.GlyphOf(character)));
        Assert.Equal(question, Atlas.GlyphOf('語'));
    }

    [Fact]
    public void Atlas_EverySheet_HasVisibleAndDifferentLetters()
    {
        foreach (var sheet in Atlas.Sheets)
        {
            var cell = sheet.CellWidth * sheet.CellHeight;
            ReadOnlySpan<byte> Coverage(char character) => sheet.Coverage.AsSpan(Atlas.GlyphOf(character) * cell, cell);
            Assert.Equal(0, Coverage(' ').IndexOfAnyExcept((byte)0) + 1);
            foreach (var character in "AZaz09·×→")
            {
                Assert.True(Coverage(character).IndexOfAnyInRange((byte)200, (byte)255) >= 0, $"{character} at {sheet.CellHeight}");
            }

            Assert.False(Coverage('A').SequenceEqual(Coverage('B')));
        }
    }

    [SkippableFact]
    public void Text_OneLetter_IsDrawnOneTexelAPixel()
    {
        var sheet = Atlas.Sheets.Single(item => item.CellHeight == 19);
        foreach (var character in "AB")
        {
            // The panel is at (margin, margin), the text after its padding (OverlayLayout).
            var image = Draw(1280, 720, OverlayPanel.OfText(OverlayAnchor.TopLeft, character.ToString()));
            var left = (sheet.CellHeight / 2) + sheet.CellWidth;
            var top = (sheet.CellHeight / 2) + (sheet.CellWidth * 3 / 4);
            var cell = sheet.CellWidth * sheet.CellHeight;
            for (var i = 0; i < cell; i++)
            {
                var coverage = sheet.Coverage[(Atlas.GlyphOf(character) * cell) + i] / 255.0;
                var ground = 0.055 * 0.85;
                var expected = 255 * (ground + (coverage * (0.93 - ground)));
                var found = image[left + (i % sheet.CellWidth), top + (i / sheet.CellWidth)].Red;
                Assert.InRange(found, expected - 2, expected + 2);
            }
        }
    }

    [SkippableTheory]
    [InlineData(OverlayAnchor.TopLeft, 0, 0)]
    [InlineData(OverlayAnchor.BottomLeft, 0, 1)]
    public void Panel_AtACorner_StaysInItsQuarter(OverlayAnchor anchor, int column, int row)
    {
        var image = Draw(1280, 720, OverlayPanel.OfText(anchor, "one line", "and another"));
        for (var quarter = 0; quarter < 4; quarter++)
        {
            var lit = CountLitPixels(image, 640 * (quarter & 1), 360 * (quarter >> 1), 640, 360);
            Assert.Equal(quarter == column + (2 * row), lit > 100);
        }
    }

    [SkippableTheory]
    [InlineData(0.0)]
    [InlineData(0.25)]
    [InlineData(0.8)]
    [InlineData(1.0)]
    public void Progress_Fraction_FillsThatFractionOfTheBar(double fraction)
    {
        var image = Draw(1280, 720, new OverlayPanel(OverlayAnchor.Centre, []) { Progress = fraction });
        var row = Enumerable.Range(300, 120).MaxBy(y => CountLitPixels(image, 0, y, 1280, 1));
        var filled = Enumerable.Range(0, 1280).Count(x => image[x, row].Blue > 150);
        // The bar has 32 cells of 10 pixels, less a few at its round ends.
        Assert.InRange(filled, (320 * fraction) - 6, (320 * fraction) + 6);
    }

    [SkippableFact]
    public void Text_InALargerFrame_IsLarger()
    {
        var small = Draw(1280, 720, OverlayPanel.OfText(OverlayAnchor.TopLeft, "size"));
        var large = Draw(2560, 1440, OverlayPanel.OfText(OverlayAnchor.TopLeft, "size"));
        Assert.InRange((double)CountLitPixels(large, 0, 0, 2560, 1440) / CountLitPixels(small, 0, 0, 1280, 720), 2.5, 5.5);
    }

    [SkippableFact]
    public void Text_LongLine_IsWrappedIntoTheFrame()
    {
        var image = Draw(400, 300, OverlayPanel.OfText(OverlayAnchor.TopLeft, string.Concat(Enumerable.Repeat("word ", 60)) + "end"));
        // Nothing reaches the last columns, and there are several lines of text.
        Assert.Equal(0, CountLitPixels(image, 395, 0, 5, 300));
        Assert.True(CountLitPixels(image, 0, 60, 400, 20) > 20);
    }

    [Fact]
    public void Text_LongLineOfParts_IsWrappedBetweenThem()
    {
        var panel = OverlayPanel.OfText(OverlayAnchor.TopLeft, "a part of words · another part · H: keys");
        var layout = OverlayLayout.Create([panel], new(0, 0, 290, 300));
        // The second line begins with the last part, without the separator.
        var glyphs = layout.Quads.Where(static quad => quad.Glyph >= 0);
        var rows = glyphs.GroupBy(static quad => quad.Y).OrderBy(static row => row.Key).ToArray();
        Assert.Equal(2, rows.Length);
        Assert.Equal(Atlas.GlyphOf('H'), (int)rows[1].MinBy(static quad => quad.X)!.Glyph);
    }

    /// <summary>As in the smallest windows, where no smaller text would help.</summary>
    [Theory]
    [InlineData(200, 150)]
    [InlineData(300, 400)]
    public void Question_WiderThanTheFrame_IsWrapped(int width, int height)
    {
        var question = TableOf(
            OverlayAnchor.Centre, "A title that is wider than the frame", [("T", "a tree: a trunk with branches"), ("Esc", "cancel")]);
        var layout = OverlayLayout.Create([question], new(0, 0, width, height));
        Assert.All(layout.Quads, quad => Assert.InRange(quad.X, 0, width - quad.Width));
        Assert.Equal(5, layout.Quads.Count(static quad => quad.Glyph == Atlas.GlyphOf('r')));
    }

    [Theory]
    [InlineData(null, 16)]
    [InlineData(32, 32)]
    public void Text_OfAWantedHeight_HasIt(int? wanted, int closest)
    {
        var layout = OverlayLayout.Create([OverlayPanel.OfText(OverlayAnchor.TopLeft, "text")], new(0, 0, 700, 400), wanted);
        Assert.InRange(Atlas.Sheets[layout.SheetIndex].CellHeight, closest - 2, closest + 2);
    }

    [Fact]
    public void Table_TwoColumns_AlignsTheSecond()
    {
        var panels = new[] { TableOf(OverlayAnchor.TopLeft, "Keys", [("W", "||"), ("LONGER", "||")]) };
        var layout = OverlayLayout.Create(panels, new(0, 0, 1280, 720));
        var bars = layout.Quads.Where(quad => (int)quad.Glyph == Atlas.GlyphOf('|')).Select(quad => quad.X).Distinct().Order().ToArray();
        Assert.Equal(2, bars.Length);
    }

    [Fact]
    public void Panel_WithTheSameContents_IsEqual()
    {
        Assert.Equal(OverlayPanel.OfText(OverlayAnchor.TopLeft, "a"), OverlayPanel.OfText(OverlayAnchor.TopLeft, "a"));
        Assert.NotEqual(OverlayPanel.OfText(OverlayAnchor.TopLeft, "a"), OverlayPanel.OfText(OverlayAnchor.TopLeft, "b"));
    }

    private static PixelImage Draw(int width, int height, params ReadOnlySpan<OverlayPanel> panels)
    {
        using var context = new SharedContext();
        using var frame = new FrameRenderer(context);
        frame.Draw(null, RenderScenes.FrontView, width, height, new() { Background = Colour.Black });
        return frame.Capture(overlay: panels.ToArray());
    }

    private static OverlayPanel TableOf(OverlayAnchor anchor, string title, params IEnumerable<(string First, string Second)> rows) =>
        new(anchor, [.. rows.Select(static row => new OverlayLine(row.First, row.Second))]) { Title = title };

    /// <summary>Counts the pixels of a rectangle that are brighter than a panel.</summary>
    private static int CountLitPixels(PixelImage image, int x, int y, int width, int height) =>
        Enumerable.Range(y, height).Sum(row => Enumerable.Range(x, width).Count(column => image[column, row].Green > 100));
}
