using FractalEngine.Core.Geometry;

namespace FractalEngine.Render.Ui.Overlays;

/// <summary>The colours of a user interface, sRGB. All texts contrast with their grounds by at least 4.5:1 (WCAG 2.1).</summary>
/// <param name="Panel">Ground of panels, menus and dialogs.</param>
/// <param name="Title">Ground of title bars and of the menu bar.</param>
/// <param name="Control">Ground of buttons and sliders.</param>
/// <param name="HotControl">Ground of what is under the pointer.</param>
/// <param name="Field">Ground of text fields, lists and graphs.</param>
/// <param name="Fill">Filled part of sliders and progress bars.</param>
/// <param name="Selection">Ground of selected rows and of selected text.</param>
/// <param name="Border">Edges of panels and fields.</param>
/// <param name="Text">Ordinary text of all widgets.</param>
/// <param name="DimText">Text of less importance.</param>
/// <param name="Accent">Text of titles and headings.</param>
/// <param name="Warning">Text that the user should notice.</param>
/// <param name="Focus">Frame around the widget that has the keyboard.</param>
public sealed record UiTheme(
    Colour Panel, Colour Title, Colour Control, Colour HotControl, Colour Field, Colour Fill, Colour Selection, Colour Border,
    Colour Text, Colour DimText, Colour Accent, Colour Warning, Colour Focus)
{
    /// <summary>Light text on dark panels.</summary>
    public static UiTheme Dark { get; } = new(
        Panel: new(0.125, 0.137, 0.161),
        Title: new(0.173, 0.192, 0.227),
        Control: new(0.220, 0.243, 0.286),
        HotControl: new(0.275, 0.305, 0.360),
        Field: new(0.075, 0.082, 0.098),
        Fill: new(0.165, 0.340, 0.500),
        Selection: new(0.150, 0.330, 0.520),
        Border: new(0.310, 0.345, 0.405),
        Text: new(0.930, 0.940, 0.960),
        DimText: new(0.700, 0.735, 0.785),
        Accent: new(0.980, 0.840, 0.580),
        Warning: new(1.000, 0.690, 0.570),
        Focus: new(0.470, 0.740, 0.960));

    /// <summary>Dark text on light panels.</summary>
    public static UiTheme Light { get; } = new(
        Panel: new(0.945, 0.950, 0.955),
        Title: new(0.860, 0.875, 0.895),
        Control: new(0.840, 0.855, 0.880),
        HotControl: new(0.780, 0.805, 0.845),
        Field: new(1.000, 1.000, 1.000),
        Fill: new(0.650, 0.790, 0.930),
        Selection: new(0.620, 0.780, 0.940),
        Border: new(0.600, 0.630, 0.670),
        Text: new(0.070, 0.080, 0.100),
        DimText: new(0.250, 0.270, 0.310),
        Accent: new(0.380, 0.200, 0.000),
        Warning: new(0.560, 0.080, 0.020),
        Focus: new(0.020, 0.360, 0.720));
}
