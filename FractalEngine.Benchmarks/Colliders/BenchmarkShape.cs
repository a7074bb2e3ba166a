using System.Diagnostics;
using System.Globalization;
using FractalEngine.Benchmarks.Measuring;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Generation;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Benchmarks.Colliders;

/// <summary>
/// A shape on which colliders of meshes and of fractals are compared. Where its faces do not fit into memory, only colliders of fractals
/// are.
/// </summary>
/// <param name="Name">A short name for tables and files.</param>
/// <param name="Fractal">The fractal, or null for a mesh.</param>
/// <param name="Faces">
/// All faces, those of a fractal expanded. Null where there are more than <see cref="MaxFaces"/>.
/// </param>
/// <param name="ExpansionMilliseconds">Time of the expansion in milliseconds, 0 for a mesh.</param>
internal sealed record BenchmarkShape(string Name, Fractal? Fractal, Mesh? Faces, double ExpansionMilliseconds)
{
    /// <summary>Limit of the faces: shapes with more have neither an oracle nor colliders of meshes.</summary>
    public const int MaxFaces = 3_000_000;

    private static readonly string[] MeshNames = ["spaceship-interior", "tree-stump"];

    /// <summary>
    /// Names of the shapes that are measured unless others are given. A number is the depth of a fractal or the faces of a mesh.
    /// </summary>
    public static string[] Default { get; } =
    [
        "appendix-b:3", "menger:4", "terrain:8", "tree:7", "sierpinski:5", "tetrahedron:8", "fern:3", "romanesco:3", "diamond:3",
        "shell", "snowflake", "tree-leaves", "appendix-b-structure:4", "spaceship-interior:200000", "tree-stump:200000", "menger-40",
        "googol", "infinite-menger",
    ];

    /// <summary>Names of smaller shapes, of at most some 300,000 faces, for quick runs.</summary>
    public static string[] Quick { get; } =
    [
        "appendix-b:3", "menger:3", "terrain:7", "tree:6", "sierpinski:5", "tetrahedron:8", "fern:2", "romanesco:2",
        "spaceship-interior:50000", "tree-stump:50000", "menger-40", "infinite-menger",
    ];

    /// <summary>Diagonal of the bounding box, which errors are measured against.</summary>
    public double Size => Bounds.Diagonal;

    private BoundingBox Bounds => Fractal?.Bounds ?? Faces!.Bounds;

    /// <summary>Tells whether a text is the name of a shape, with a number after a colon or without.</summary>
    public static bool IsKnown(string text) => FractalCase.IsKnown(text) || text.Split(':') switch
    {
        [var name] => MeshNames.Contains(name),
        [var name, var number] => MeshNames.Contains(name) && CommandLineParser.TryParseCount(number, out _),
        _ => false,
    };

    /// <summary>Creates the shape of a name that <see cref="IsKnown"/> accepts.</summary>
    public static BenchmarkShape Create(string text)
    {
        var name = text.Split(':')[0];
        if (MeshNames.Contains(name))
        {
            int? faceCount = text == name
                ? null
                : int.Parse(text[(name.Length + 1)..], NumberStyles.None, CultureInfo.InvariantCulture);
            return new(name, null, MeshGenerators.Create(name, 1, faceCount), 0);
        }

        var fractal = FractalCase.Parse(text).Fractal;
        if (!(fractal.FaceCount <= MaxFaces))
        {
            return new(name, fractal, null, 0);
        }

        var watch = Stopwatch.StartNew();
        var faces = FractalGenerator.Flatten(fractal, MaxFaces);
        return new(name, fractal, faces, watch.Elapsed.TotalMilliseconds);
    }

    /// <summary>Creates a random position anywhere in the bounding box.</summary>
    public Vector RandomInBounds(Random random) => QueryPositions.Uniform(random, Bounds);

    /// <summary>Creates a random position near the surface.</summary>
    public Vector RandomNearSurface(Random random) =>
        Fractal is null ? QueryPositions.NearSurface(random, Faces!) : QueryPositions.NearSurface(random, Fractal);
}
