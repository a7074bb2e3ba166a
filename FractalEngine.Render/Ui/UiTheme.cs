using FractalEngine.Core.Geometry;

namespace FractalEngine.Render.Ui;

/// <summary>The colours of a user interface, sRGB. All texts contrast with their grounds by at least 4.5:1 (WCAG 2.1).</summary>
public sealed record UiTheme
{
    /// <summary>Light text on dark panels.</summary>
    public static UiTheme Dark { get; } = new()
    {
        Panel = new(0.125, 0.137, 0.161),
        Title = new(0.173, 0.192, 0.227),
        Control = new(0.220, 0.243, 0.286),
        HotControl = new(0.275, 0.305, 0.360),
        Field = new(0.075, 0.082, 0.098),
        Fill = new(0.165, 0.340, 0.500),
        Selection = new(0.150, 0.330, 0.520),
        Border = new(0.310, 0.345, 0.405),
        Text = new(0.930, 0.940, 0.960),
        DimText = new(0.700, 0.735, 0.785),
        Accent = new(0.980, 0.840, 0.580),
        Warning = new(1.000, 0.690, 0.570),
        Focus = new(0.470, 0.740, 0.960),
    };

    /// <summary>Dark text on light panels.</summary>
    public static UiTheme Light { get; } = new()
    {
        Panel = new(0.945, 0.950, 0.955),
        Title = new(0.860, 0.875, 0.895),
        Control = new(0.840, 0.855, 0.880),
        HotControl = new(0.780, 0.805, 0.845),
        Field = new(1.000, 1.000, 1.000),
        Fill = new(0.650, 0.790, 0.930),
        Selection = new(0.620, 0.780, 0.940),
        Border = new(0.600, 0.630, 0.670),
        Text = new(0.070, 0.080, 0.100),
        DimText = new(0.250, 0.270, 0.310),
        Accent = new(0.380, 0.200, 0.000),
        Warning = new(0.560, 0.080, 0.020),
        Focus = new(0.020, 0.360, 0.720),
    };

    /// <summary>Ground of panels, menus and dialogs.</summary>
    public required Colour Panel { get; init; }
    /// <summary>Ground of title bars and of the menu bar.</summary>
    public required Colour Title { get; init; }
    /// <summary>Ground of buttons and sliders.</summary>
    public required Colour Control { get; init; }
    /// <summary>Ground of what is under the pointer.</summary>
    public required Colour HotControl { get; init; }
    /// <summary>Ground of text fields, lists and graphs.</summary>
    public required Colour Field { get; init; }
    /// <summary>Filled part of sliders and progress bars.</summary>
    public required Colour Fill { get; init; }
    /// <summary>Ground of selected rows and of selected text.</summary>
    public required Colour Selection { get; init; }
    /// <summary>Edges of panels and fields.</summary>
    public required Colour Border { get; init; }
    /// <summary>Ordinary text of all widgets.</summary>
    public required Colour Text { get; init; }
    /// <summary>Text of less importance.</summary>
    public required Colour DimText { get; init; }
    /// <summary>Text of titles and headings.</summary>
    public required Colour Accent { get; init; }
    /// <summary>Text that the user should notice.</summary>
    public required Colour Warning { get; init; }
    /// <summary>Frame around the widget that has the keyboard.</summary>
    public required Colour Focus { get; init; }

    /// <summary>Computes the contrast of two colours by WCAG 2.1, from 1 to 21.</summary>
    public static double Contrast(Colour colour1, Colour colour2)
    {
        var luminance1 = Luminance(colour1);
        var luminance2 = Luminance(colour2);
        return (Math.Max(luminance1, luminance2) + 0.05) / (Math.Min(luminance1, luminance2) + 0.05);
    }

    private static double Luminance(Colour colour) =>
        (0.2126 * Linear(colour.Red)) + (0.7152 * Linear(colour.Green)) + (0.0722 * Linear(colour.Blue));

    private static double Linear(double value) => value <= 0.04045 ? value / 12.92 : Math.Pow((value + 0.055) / 1.055, 2.4);
}
