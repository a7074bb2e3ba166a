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

    /// <summary>Draws panels of text into the bound framebuffer.</summary>
    /// <inheritdoc cref="OverlayLayer.Draw"/>
    public void DrawTexts(IReadOnlyList<OverlayPanel> panels, UiRect area, int? lineHeight, int width, int height) =>
        _texts.Draw(panels, area, lineHeight, width, height);

    /// <summary>Draws questions, whose lines can be clicked, into the bound framebuffer.</summary>
    /// <inheritdoc cref="OverlayLayer.Draw"/>
    public void DrawQuestions(IReadOnlyList<OverlayPanel> panels, UiRect area, int? lineHeight, int width, int height) =>
        _questions.Draw(panels, area, lineHeight, width, height);

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
    public void Dispose() => GlObject.DisposeAll(_texts, _questions, _interfaceBatch);
}
