using FractalEngine.Render.Gl;
using FractalEngine.Render.Ui.Overlays;

namespace FractalEngine.Render.Ui.Drawing;

/// <summary>Draws panels of text and the user interface over a frame. Each is laid out and uploaded again only when it differs.</summary>
internal sealed class OverlayPass(GlResources resources) : IDisposable
{
    private readonly OverlayLayer _texts = new(resources);
    private readonly OverlayLayer _questions = new(resources);
    private QuadBatch? _interfaceBatch;
    private (UserInterface Interface, int Version, int Width, int Height)? _lastInterface;

    /// <inheritdoc cref="OverlayLayer.AnswerAt"/>
    public int? AnswerAt(OverlayPanel panel, double x, double y) => _questions.AnswerAt(panel, x, y);

    /// <summary>Draws panels of text, and a user interface as it was built last, into the bound framebuffer.</summary>
    /// <param name="ui">The interface; null for none.</param>
    /// <param name="panels">Panels of text, of which questions have lines that can be clicked.</param>
    /// <param name="width">Width of the framebuffer in pixels.</param>
    /// <param name="height">Height of the framebuffer in pixels.</param>
    public void Draw(UserInterface? ui, IReadOnlyList<OverlayPanel> panels, int width, int height)
    {
        // An open menu, a dialog or a tooltip lies over texts, which lie over panels. A question lies over all of these.
        var isInFront = ui is { IsModal: true } or { HasTooltip: true };
        var frame = new UiRect(0, 0, width, height);
        var lineHeight = ui?.Sheet.CellHeight;
        DrawInterface(isInFront ? null : ui, width, height);
        _texts.Draw(panels.Where(static panel => !panel.IsQuestion).ToArray(), ui?.OverlayArea ?? frame, lineHeight, width, height);
        DrawInterface(isInFront ? ui : null, width, height);
        _questions.Draw(panels.Where(static panel => panel.IsQuestion).ToArray(), frame, lineHeight, width, height);
    }

    /// <inheritdoc/>
    public void Dispose() => GlObject.DisposeAll(_texts, _questions, _interfaceBatch);

    private void DrawInterface(UserInterface? ui, int width, int height)
    {
        if (ui is null)
        {
            return;
        }

        _interfaceBatch ??= new(resources);
        if (_lastInterface != (ui, ui.Version, width, height))
        {
            _interfaceBatch.Upload(ui.Quads, ui.Sheet, width, height);
            _lastInterface = (ui, ui.Version, width, height);
        }

        _interfaceBatch.Draw();
    }
}
