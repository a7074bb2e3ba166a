using FractalEngine.Render.Gl;
using FractalEngine.Render.Ui;

namespace FractalEngine.Render.Passes;

/// <summary>Draws panels of text and the user interface over a frame. Each is laid out and uploaded again only when it differs.</summary>
internal sealed class OverlayPass(GlResources resources) : IDisposable
{
    private readonly GlyphAtlas _atlas = GlyphAtlas.Shared;
    private readonly QuadBatch _panelBatch = new(resources);
    private QuadBatch? _interfaceBatch;
    private (OverlayPanel[] Panels, UiRect Area, int? LineHeight, int Width, int Height)? _lastKey;
    private (UserInterface Interface, int Version, int Width, int Height)? _lastInterface;

    private (UiRect Area, int Answer)[] _answers = [];

    /// <summary>Returns what a click on a line of a panel answers; null beside all such lines, and before the panel was drawn.</summary>
    /// <param name="panel">The panel, the only one with answers.</param>
    /// <param name="x">Pixels of the framebuffer from its left edge.</param>
    /// <param name="y">Pixels of the framebuffer from its upper edge.</param>
    public int? AnswerAt(OverlayPanel panel, double x, double y)
    {
        // Another question may have been drawn last.
        if (_lastKey?.Panels.Contains(panel) != true)
        {
            return null;
        }

        foreach (var (area, answer) in _answers)
        {
            if (x >= area.X && x < area.X + area.Width && y >= area.Y && y < area.Y + area.Height)
            {
                return answer;
            }
        }

        return null;
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
            var layout = OverlayLayout.Create(_atlas, panels, area.Width, area.Height, lineHeight);
            var quads = layout.Quads.ConvertAll(quad => quad with { X = quad.X + area.X, Y = quad.Y + area.Y });
            _answers = [.. layout.Answers.Select(
                item => (item.Area with { X = item.Area.X + area.X, Y = item.Area.Y + area.Y }, item.Answer))];
            _panelBatch.Upload(quads, _atlas.Sheets[layout.SheetIndex], width, height);
            _lastKey = ([.. panels], area, lineHeight, width, height);
        }

        _panelBatch.Draw();
    }

    /// <summary>Draws a user interface as it was built last into the bound framebuffer.</summary>
    /// <param name="ui">The interface.</param>
    /// <param name="width">Width of the framebuffer in pixels.</param>
    /// <param name="height">Height of the framebuffer in pixels.</param>
    public void Draw(UserInterface ui, int width, int height)
    {
        _interfaceBatch ??= new(resources);
        if (_lastInterface != (ui, ui.Version, width, height))
        {
            _interfaceBatch.Upload(ui.Quads, ui.Sheet, width, height);
            _lastInterface = (ui, ui.Version, width, height);
        }

        _interfaceBatch.Draw();
    }

    /// <inheritdoc/>
    public void Dispose()
    {
        _panelBatch.Dispose();
        _interfaceBatch?.Dispose();
    }
}
