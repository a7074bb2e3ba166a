using System.Collections.Immutable;
using FractalEngine.Core;

namespace FractalEngine.Parsing.Text;

/// <summary>Limits on the input of all parsers. Each bounds time or memory and is named in the error that it causes.</summary>
public static class ParsingLimits
{
    /// <summary>Largest size of a mesh file in bytes, decompressed: 1 GiB. Reading takes up to twice the memory of the mesh.</summary>
    public static Limit ObjBytes { get; } = new(
        "obj-bytes", 1L << 30, "bytes of a mesh file", "reading takes up to twice the memory of the mesh", 1L << 40);

    /// <summary>Largest size of a scene or fractal file in bytes: 16 MiB, far beyond what anyone writes.</summary>
    public static Limit DescriptionBytes { get; } = new(
        "description-bytes", 1L << 24, "bytes of a scene or fractal file", "far beyond what anyone writes");

    /// <summary>Largest number of lines of a scene file: about 70 MB where each is an object.</summary>
    public static Limit SceneLines { get; } = new(
        "scene-lines", 100_000, "lines of a scene file", "about 70 MB where each is an object");

    /// <summary>Largest size of a file of points in bytes: 256 MiB.</summary>
    public static Limit PointsBytes { get; } = new(
        "points-bytes", 1L << 28, "bytes of a file of points", "memory: the text is held as a whole", 1L << 29);

    /// <summary>Largest number of transformations in all sets of a fractal file: about 50 MB.</summary>
    public static Limit Maps { get; } = new(
        "maps", 200_000, "transformations in all sets of a fractal file", "about 50 MB");

    /// <summary>Largest number of named objects and transformations of a fractal file: about 70 MB.</summary>
    public static Limit Names { get; } = new(
        "names", 150_000, "named objects and transformations of a fractal file", "about 70 MB");

    /// <summary>Largest number of steps that all recursives of a fractal file repeat: 8 MB.</summary>
    public static Limit RepeatedSteps { get; } = new(
        "repeated-steps", 1_000_000, "steps that all recursives and sums of a fractal file repeat", "8 MB");

    /// <summary>Largest number of terms of expressions of a fractal file, a function's counted at each call: a second or two.</summary>
    public static Limit ExpressionTerms { get; } = new(
        "expression-terms", 5_000_000, "terms of expressions in all calls of a fractal file", "a second or two", 1_000_000_000);

    /// <summary>Largest number of base meshes of a fractal, counted as often as its files name them.</summary>
    public static Limit BaseFiles { get; } = new(
        "base-files", 200, "base meshes of a fractal, as often as files name them", "each is drawn by itself", 100_000);

    /// <summary>Largest size of a material file in bytes: 16 MiB.</summary>
    public static Limit MaterialBytes { get; } = new(
        "material-bytes", 1L << 24, "bytes of a material file", "far beyond what anyone writes");

    /// <summary>Largest size of an image file in bytes: 64 MiB.</summary>
    public static Limit ImageBytes { get; } = new(
        "image-bytes", 1L << 26, "bytes of an image file", "memory");

    /// <summary>Largest width or height of an image in pixels: what every driver of the last fifteen years can hold.</summary>
    public static Limit ImageSide { get; } = new(
        "image-side", 8192, "pixels along a side of an image", "what every driver of the last fifteen years can hold", 1 << 16);

    /// <summary>Largest number of pixels in all images that one loaded file refers to, directly or not: 512 MiB when decoded.</summary>
    public static Limit TotalImagePixels { get; } = new(
        "image-pixels", 1L << 27, "pixels of all images of one file", "512 MiB, decoded", 1L << 40);

    /// <summary>Largest number of pixels of a sky's image, 8192×4096: 800 MB with what is made of it.</summary>
    public static Limit SkyPixels { get; } = new(
        "sky-pixels", 1L << 25, "pixels of the image of a sky", "800 MB, with what is made of it", 1L << 28);

    /// <summary>Largest number of corners of one polygon. Cutting it takes a time that is quadratic at worst.</summary>
    public static Limit PolygonCorners { get; } = new(
        "polygon-corners", 20_000, "corners of a polygon", "cutting it takes a time of their square at worst");

    /// <summary>Largest number of corners of a glTF file: vertices or indices of each mesh, as often as nodes show it.</summary>
    public static Limit GltfCorners { get; } = new(
        "gltf-corners", 100_000_000, "corners of all nodes of a glTF file", "about 6 GB", 500_000_000);

    /// <summary>All limits of parsers, in the order of a listing.</summary>
    public static ImmutableArray<Limit> All { get; } =
    [
        ObjBytes, DescriptionBytes, SceneLines, PointsBytes, Maps, Names, RepeatedSteps, ExpressionTerms, BaseFiles, MaterialBytes,
        ImageBytes, ImageSide, TotalImagePixels, SkyPixels, PolygonCorners, GltfCorners,
    ];
}
