using FractalEngine.Render.Gl;
using FractalEngine.Render.Ui.Overlays;
using FractalEngine.Render.Ui.Painting;

namespace FractalEngine.Render.Ui.Drawing;

/// <summary>Panels of text that are drawn together. They are laid out and uploaded again only when they differ.</summary>
internal sealed class OverlayLayer(GlResources resources) : IDisposable
{
    private readonly QuadBatch _batch = new(resources);
    private (OverlayPanel[] Panels, UiRect Area, int? LineHeight, int Width, int Height)? _lastKey;
    private (UiRect Area, int Answer)[] _answers = [];

    /// <summary>Returns what a click on a line of a panel answers; null beside all such lines, and before the panel was drawn.</summary>
    /// <param name="panel">The panel, the only one with answers.</param>
    /// <param name="x">Pixels of the framebuffer from its left edge.</param>
    /// <param name="y">Pixels of the framebuffer from its upper edge.</param>
    public int? AnswerAt(OverlayPanel panel, double x, double y)
    {
        // Another question may have been drawn last.
        var answers = _lastKey?.Panels.Contains(panel) == true ? _answers : [];
        return answers.Where(item => item.Area.Contains(x, y)).Select(static item => (int?)item.Answer).FirstOrDefault();
    }

    /// <summary>Draws panels into the bound framebuffer.</summary>
    /// <param name="panels">Panels to draw; none draws nothing.</param>
    /// <param name="area">The part of the frame that the panels stand in.</param>
    /// <param name="lineHeight">Wanted height of a line of text in pixels; null for one that follows the area.</param>
    /// <param name="width">Width of the framebuffer in pixels.</param>
    /// <param name="height">Height of the framebuffer in pixels.</param>
    public void Draw(IReadOnlyList<OverlayPanel> panels, UiRect area, int? lineHeight, int width, int height)
    {
        if (panels.Count == 0)
        {
            _answers = [];
            _lastKey = null;
            return;
        }

        if (_lastKey is not { } last || (last.Area, last.LineHeight, last.Width, last.Height) != (area, lineHeight, width, height)
            || !last.Panels.SequenceEqual(panels))
        {
            var layout = OverlayLayout.Create(panels, area, lineHeight);
            _answers = [.. layout.Answers];
            _batch.Upload(layout.Quads, GlyphAtlas.Shared.Sheets[layout.SheetIndex], width, height);
            _lastKey = ([.. panels], area, lineHeight, width, height);
        }

        _batch.Draw();
    }

    /// <inheritdoc/>
    public void Dispose() => _batch.Dispose();
}
