namespace FractalEngine.Core.Images;

/// <summary>What the samples of a pixel mean; the values are those of the file (PNG, third edition, table 8).</summary>
public enum PngColourType
{
    /// <summary>One sample of grey.</summary>
    Grey = 0,

    /// <summary>Red, green, blue.</summary>
    Rgb = 2,

    /// <summary>One index into a palette.</summary>
    Palette = 3,

    /// <summary>Grey, alpha.</summary>
    GreyAlpha = 4,

    /// <summary>Red, green, blue, alpha.</summary>
    Rgba = 6,
}
