namespace FractalEngine.Render.Images;

/// <summary>
/// Offsets that keep a slow gradient from showing bands when it is rounded to a few values: each pixel has its own, and the mean of a
/// neighbourhood stays what it was.
/// </summary>
internal static class OrderedDither
{
    /// <summary>Pixels after which the pattern repeats, along each axis.</summary>
    public const int Size = 8;

    /// <summary>
    /// Returns the offset of a pixel as a part of the step between two values, between −½ and ½: what is such a value stays as it is. The
    /// pattern is that of B. Bayer, "An optimum method for two-level rendition of continuous-tone pictures", 1973.
    /// </summary>
    public static double At(int x, int y)
    {
        var both = x ^ y;
        var rank = ((both & 1) << 5) | ((y & 1) << 4) | ((both & 2) << 2) | ((y & 2) << 1) | ((both & 4) >> 1) | ((y & 4) >> 2);
        return ((rank + 0.5) / (Size * Size)) - 0.5;
    }
}
