using FractalEngine.Core.Geometry;
using FractalEngine.Render.Ui.Input;
using FractalEngine.Render.Ui.Overlays;
using FractalEngine.Render.Ui.Painting;

namespace FractalEngine.Render.Ui;

/// <summary>Texts, knobs and handles anywhere in the frame.</summary>
internal sealed class UiMarks(UiInput input, UiPainter painter, UiTargets targets)
{
    public void AddText(string text, double x, double y)
    {
        painter.Begin(layer: 0);
        var rect = PlaceAt(x, y, (text.Length * painter.CellWidth) + (2 * painter.Gap));
        painter.Fill(rect, painter.Theme.Panel, 3);
        painter.Print(text, rect, painter.Theme.Text, align: 0.5);
    }

    public UiTouch AddKnob(string label, string name, double x, double y, Colour colour)
    {
        var rect = PlaceAt(x, y, painter.RowHeight);
        targets.BeginRoot(name, rect, layer: 0);
        var touch = targets.Touch(name, rect, takesFocus: false);
        painter.Fill(rect, colour, rect.Width / 2f);
        painter.Print(label, rect, touch.IsHot ? UiTheme.Dark.Accent : UiTheme.Dark.Text, align: 0.5);
        return touch;
    }

    public UiHandle AddHandle(string label, string name, double x, double y, Colour colour)
    {
        var touch = AddKnob(label, name, x, y, colour);
        return new(touch.IsHot, touch.IsPressed, touch.IsHeld, input.X, input.Y, input.IsControlHeld);
    }

    private UiRect PlaceAt(double x, double y, int width) =>
        new((int)x - (width / 2), (int)y - (painter.RowHeight / 2), width, painter.RowHeight);
}
