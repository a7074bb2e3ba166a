namespace FractalEngine.Core.Images;

/// <summary>What the samples of a pixel mean; the values are those of the file (PNG, third edition, table 8).</summary>
public enum PngColourType
{
    /// <summary>One sample of grey.</summary>
    Grey = 0,

    /// <summary>Samples of red, green and blue.</summary>
    Rgb = 2,

    /// <summary>One index into a palette.</summary>
    Palette = 3,

    /// <summary>Samples of grey and alpha.</summary>
    GreyAlpha = 4,

    /// <summary>Red, green, blue, alpha.</summary>
    Rgba = 6,
}
