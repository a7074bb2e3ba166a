namespace FractalEngine.Parsing;

/// <summary>The stated limits of what is read. Each bounds time or memory, and is named in the error that it causes.</summary>
public static class ParsingLimits
{
    /// <summary>The longest mesh file: 1 GiB. A text in memory takes two bytes a character.</summary>
    public const long ObjBytes = 1L << 30;

    /// <summary>The longest scene or fractal file: 16 MiB, far beyond what anyone writes.</summary>
    public const long DescriptionBytes = 1L << 24;

    /// <summary>The longest material file: 16 MiB.</summary>
    public const long MaterialBytes = 1L << 24;

    /// <summary>The longest file of a picture: 64 MiB.</summary>
    public const long ImageBytes = 1L << 26;

    /// <summary>The most pixels of a picture's side: what every driver of the last fifteen years can hold.</summary>
    public const int ImageSide = 8192;

    /// <summary>The most pixels of all pictures that a file and those it refers to name: 512 MiB, decoded.</summary>
    public const long TotalImagePixels = 1L << 27;

    /// <summary>The most corners of one polygon. Ear clipping takes the square of their number at worst: half a second here.</summary>
    public const int PolygonCorners = 20_000;
}
