namespace FractalEngine.Parsing;

/// <summary>Limits on the input of all parsers. Each bounds time or memory and is named in the error that it causes.</summary>
public static class ParsingLimits
{
    /// <summary>Largest size of a mesh file in bytes: 1 GiB. Reading takes up to twice the memory of the mesh.</summary>
    public const long MaxObjBytes = 1L << 30;

    /// <summary>Largest size of a scene or fractal file in bytes: 16 MiB, far beyond what anyone writes.</summary>
    public const long MaxDescriptionBytes = 1L << 24;

    /// <summary>Largest number of transformations in all sets of a fractal file: about 50 MB.</summary>
    public const int MaxMaps = 200_000;

    /// <summary>Largest number of named objects and transformations of a fractal file: about 50 MB.</summary>
    public const int MaxNames = 150_000;

    /// <summary>Largest number of steps that all recursives of a fractal file repeat: 8 MB.</summary>
    public const int MaxRepeatedSteps = 1_000_000;

    /// <summary>Largest size of a material file in bytes: 16 MiB.</summary>
    public const long MaxMaterialBytes = 1L << 24;

    /// <summary>Largest size of an image file in bytes: 64 MiB.</summary>
    public const long MaxImageBytes = 1L << 26;

    /// <summary>Largest width or height of an image in pixels: what every driver of the last fifteen years can hold.</summary>
    public const int MaxImageSide = 8192;

    /// <summary>Largest number of pixels in all images that one loaded file refers to, directly or not: 512 MiB when decoded.</summary>
    public const long MaxTotalImagePixels = 1L << 27;

    /// <summary>Largest number of corners of one polygon. Cutting it takes a time that is quadratic at worst.</summary>
    public const int MaxPolygonCorners = 20_000;
}
