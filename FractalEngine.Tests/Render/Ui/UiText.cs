using FractalEngine.Render.Ui;
using FractalEngine.Render.Ui.Overlays;

namespace FractalEngine.Tests.Render.Ui;

/// <summary>Reads the texts that a user interface draws.</summary>
internal static class UiText
{
    /// <summary>Finds where a text is drawn first, the last drawn in front.</summary>
    public static (double X, double Y) Find(UserInterface ui, string text, bool centred = true)
    {
        var found = Places(ui, text).LastOrDefault();
        Assert.True(found != default, $"'{text}' is not drawn");
        return (found.X + (centred ? 0.5 * text.Length * found.Width : 0), found.Y + (0.5 * found.Height));
    }

    /// <summary>Tells whether a text is drawn.</summary>
    public static bool Contains(UserInterface ui, string text) => Places(ui, text).Any();

    private static IEnumerable<OverlayQuad> Places(UserInterface ui, string text)
    {
        var glyphs = text.Select(static character => character == ' ' ? -1 : GlyphAtlas.Shared.GlyphOf(character)).ToArray();
        var byPlace = ui.Quads.Where(static quad => quad.Glyph >= 0).ToLookup(static quad => (quad.X, quad.Y));
        return ui.Quads.Where(quad => quad.Glyph == glyphs[0] && glyphs.Index().All(item =>
            byPlace[(quad.X + (item.Index * quad.Width), quad.Y)].Any(other => other.Glyph == item.Item)
            || (item.Item < 0 && !byPlace[(quad.X + (item.Index * quad.Width), quad.Y)].Any())));
    }
}
