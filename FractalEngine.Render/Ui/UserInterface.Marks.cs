using FractalEngine.Core.Geometry;
using FractalEngine.Render.Ui.Overlays;

namespace FractalEngine.Render.Ui;

/// <content>Texts, knobs and handles anywhere in the frame.</content>
public sealed partial class UserInterface
{
    /// <summary>Writes a text at a point of the frame, behind all panels. It takes no input.</summary>
    /// <param name="text">A few words or a number.</param>
    /// <param name="x">Pixels from the left edge of the frame to the middle of the text.</param>
    /// <param name="y">Pixels from the upper edge of the frame to the middle of the text.</param>
    public void Mark(string text, double x, double y)
    {
        ArgumentNullException.ThrowIfNull(text);
        _layer = 0;
        _clip = new(0, 0, _width, _height);
        var width = (text.Length * CellWidth) + (2 * Gap);
        var rect = new UiRect((int)x - (width / 2), (int)y - (RowHeight / 2), width, RowHeight);
        Fill(rect, Theme.Panel, 3);
        Print(text, rect, Theme.Text, UiAlign.Middle);
    }

    /// <summary>Adds a round button anywhere in the frame, before what was added earlier.</summary>
    /// <param name="label">One or two characters, and the identity of the button.</param>
    /// <param name="x">Pixels from the left edge of the frame to the middle.</param>
    /// <param name="y">Pixels from the upper edge of the frame to the middle.</param>
    /// <param name="colour">Ground of the button; dark, since the text is light.</param>
    /// <returns>True when the button was pressed.</returns>
    public bool Knob(string label, double x, double y, Colour colour)
    {
        ArgumentNullException.ThrowIfNull(label);
        return AddKnob(label, x, y, colour).IsActivated;
    }

    /// <summary>Adds a round handle anywhere in the frame, which is dragged.</summary>
    /// <param name="label">One or two characters.</param>
    /// <param name="name">Identity of the handle.</param>
    /// <param name="x">Pixels from the left edge of the frame to the middle.</param>
    /// <param name="y">Pixels from the upper edge of the frame to the middle.</param>
    /// <param name="colour">Ground of the handle; dark, since the text is light.</param>
    /// <remarks>The handle keeps the pointer until the button is released, wherever it is added meanwhile.</remarks>
    public UiHandle Handle(string label, string name, double x, double y, Colour colour)
    {
        ArgumentNullException.ThrowIfNull(label);
        ArgumentNullException.ThrowIfNull(name);
        var touch = AddKnob(label, x, y, colour, name);
        return new(touch.IsHot, touch.IsPressed, touch.IsHeld, _input.X, _input.Y, _input.IsControlHeld);
    }

    private UiTouch AddKnob(string label, double x, double y, Colour colour, string? name = null)
    {
        var size = RowHeight;
        var rect = new UiRect((int)x - (size / 2), (int)y - (size / 2), size, size);
        var id = IdOf(name ?? label);
        BeginRoot(id, rect, layer: 0);
        var touch = Touch(id, rect, takesFocus: false);
        Fill(rect, colour, size / 2f);
        Print(label, rect, touch.IsHot ? UiTheme.Dark.Accent : UiTheme.Dark.Text, UiAlign.Middle);
        return touch;
    }
}
