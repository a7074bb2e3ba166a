using System.Diagnostics;
using System.Globalization;
using FractalEngine.Benchmarks.Measuring;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Generation;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Benchmarks.Colliders;

/// <summary>
/// A shape that colliders of meshes and of fractals can be compared on; where its faces do not fit into memory, only those of fractals.
/// </summary>
/// <param name="Name">Short, for tables and files.</param>
/// <param name="Fractal">Null for a mesh.</param>
/// <param name="Faces">All of them; of a fractal, expanded; null where there are more than <see cref="MaxFaces"/>.</param>
/// <param name="ExpansionMilliseconds">What it took to expand them; 0 for a mesh.</param>
internal sealed record BenchmarkShape(string Name, Fractal? Fractal, Mesh? Faces, double ExpansionMilliseconds)
{
    /// <summary>Shapes with more faces have no oracle, and no colliders of meshes.</summary>
    public const int MaxFaces = 3_000_000;

    private static readonly string[] Meshes = ["spaceship-interior", "tree-stump"];

    /// <summary>The shapes unless others are named; a number is the depth of a fractal, or the faces of a mesh.</summary>
    public static string[] Default { get; } =
    [
        "appendix-b:3", "menger:4", "terrain:8", "tree:7", "sierpinski:5", "tetrahedron:8", "fern:3", "romanesco:3", "diamond:3", "shell",
        "snowflake", "tree-leaves", "appendix-b-structure:4",
        "spaceship-interior:200000", "tree-stump:200000", "menger-40", "googol", "infinite-menger",
    ];

    /// <summary>The same with fewer faces: at most some 300,000.</summary>
    public static string[] Quick { get; } =
    [
        "appendix-b:3", "menger:3", "terrain:7", "tree:6", "sierpinski:5", "tetrahedron:8", "fern:2", "romanesco:2",
        "spaceship-interior:50000", "tree-stump:50000", "menger-40", "infinite-menger",
    ];

    /// <summary>The diagonal of the box: what errors are parts of.</summary>
    public double Size => Bounds.Diagonal;

    private BoundingBox Bounds => Fractal?.Bounds ?? Faces!.Bounds;

    /// <summary>True for the name of a shape, with a number after a colon or without.</summary>
    public static bool IsKnown(string text) => FractalCase.IsKnown(text) || text.Split(':') switch
    {
        [var name] => Meshes.Contains(name),
        [var name, var number] => Meshes.Contains(name) && CommandLineParser.TryParseCount(number, out _),
        _ => false,
    };

    /// <summary>Makes the shape of a name.</summary>
    public static BenchmarkShape Create(string text)
    {
        var name = text.Split(':')[0];
        if (Meshes.Contains(name))
        {
            return new(name, null,
                MeshGenerators.Create(name, 1, text == name
                ? null
                : int.Parse(text[(name.Length + 1)..], NumberStyles.None, CultureInfo.InvariantCulture)), 0);
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

    /// <summary>Anywhere in its box.</summary>
    public Vector RandomInBounds(Random random) => QueryPositions.Uniform(random, Bounds);

    /// <summary>Near a random face.</summary>
    public Vector RandomNearSurface(Random random) =>
        Fractal is null ? QueryPositions.NearSurface(random, Faces!) : QueryPositions.NearSurface(random, Fractal);
}
