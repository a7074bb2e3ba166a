using System.Globalization;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Parsing.Assets;
using FractalEngine.Parsing.Assets.References;

namespace FractalEngine.Benchmarks.Measuring;

/// <summary>A fractal that is measured, with a name.</summary>
/// <param name="Name">A short name for tables, with the depth where one was asked for.</param>
/// <param name="Fractal">The fractal at that depth.</param>
internal sealed record FractalCase(string Name, Fractal Fractal)
{
    /// <summary>
    /// Names beside those of the assets. three-branches has three branches of 0.6 in different directions. four-fronds has four maps, none
    /// of which keeps shapes, like a fern's. binary-tree keeps its trunk at each level by the identity, so that most of its chains are one
    /// instance.
    /// </summary>
    private static readonly string[] BuiltInNames = ["three-branches", "four-fronds", "binary-tree"];

    /// <summary>Names of all fractals that can be measured.</summary>
    public static IEnumerable<string> Names => Directory.GetFiles(Path.Combine(Assets, "fractals"), "*.fdo")
        .Select(file => Path.GetFileNameWithoutExtension(file)).Order(StringComparer.Ordinal).Concat(BuiltInNames);

    /// <summary>Folder of the scenes, fractals and meshes.</summary>
    public static string Assets { get; } = FindAssets();

    /// <summary>Tells whether a text is the name of a fractal, or its name and depth: <c>tree</c> or <c>tree:20</c>.</summary>
    public static bool IsKnown(string text) => text.Split(':') switch
    {
        [var name] => Names.Contains(name),
        [var name, var depth] =>
            Names.Contains(name) && CommandLineParser.TryParseCount(depth, out var count) && count <= FractalLimits.Depth.Value,
        _ => false,
    };

    /// <summary>Loads a fractal by its name, or its name and depth: <c>tree</c> or <c>tree:20</c>.</summary>
    public static FractalCase Parse(string text) => text.Split(':') switch
    {
        [var name, var depth] => Load(name, int.Parse(depth, CultureInfo.InvariantCulture)),
        _ => Load(text),
    };

    /// <summary>Loads a fractal by its name.</summary>
    /// <param name="name">One of <see cref="Names"/>.</param>
    /// <param name="depth">Depth of its outermost recursion; null for the depth in its file.</param>
    public static FractalCase Load(string name, int? depth = null)
    {
        var fractal = name switch
        {
            "three-branches" => new(ThreeBranches, LoadMesh("hexagonal-pyramid")),
            "four-fronds" => new(FourFronds, LoadMesh("hexagonal-pyramid")),
            "binary-tree" => new(BinaryTree, LoadMesh("hexagonal-pyramid")),
            _ => ((FractalModel)LoadModel("fractals", name + ".fdo")).Fractal,
        };
        return depth is { } count && fractal.Description.HasDepth
            ? new($"{name} {count}", fractal.WithDepth(count))
            : new(name, fractal);
    }

    /// <summary>Copies a fractal without the hierarchy that it keeps for its colliders, so that building one is measured whole.</summary>
    public static Fractal Copy(Fractal fractal) => new(fractal.Description, fractal.BaseMesh);

    private static FractalDescription ThreeBranches { get; } = Repeat(
        new(new(0, 1, 0), new(0, 40, 8), 0.6 * Vector.One),
        new(new(0.1, 0.9, 0), new(20, 0, 50), 0.6 * Vector.One),
        new(new(0, 0.8, 0.1), new(-45, 130, 0), 0.6 * Vector.One));

    private static FractalDescription FourFronds { get; } = Repeat(
        new(new(0, 0.16, 0), new(0, 10, 3), new(0.85, 0.84, 0.86)),
        new(new(0, 0.16, 0), new(10, 20, 52), new(0.3, 0.34, 0.25)),
        new(new(0, 0.05, 0), new(-10, -20, -49), new(-0.28, 0.37, 0.3)),
        new(new(0, 0, 0), new(0, 0, 0), new(0.05, 0.2, 0.05)));

    private static FractalDescription BinaryTree { get; } = Repeat(
        Transformation.Identity,
        new(new(0, 0.7, 0), new(0, 70, 24), 0.76 * Vector.One),
        new(new(0, 0.8, 0), new(0, -40, -31), 0.7 * Vector.One));

    private static FractalDescription Repeat(params Transformation[] maps) =>
        new([new Repetition([new TransformationSet([.. maps])], 5)]);

    private static Mesh LoadMesh(string name) => LoadModel("models", name + ".obj").Mesh;

    private static Model LoadModel(string folder, string file) =>
        AssetLoader.Load(Path.Combine(Assets, folder, file)).Scene.Objects[0].Model;

    private static string FindAssets()
    {
        for (var folder = AppContext.BaseDirectory; folder is not null; folder = Path.GetDirectoryName(folder))
        {
            if (File.Exists(Path.Combine(folder, "assets", AssetFolder.MarkerName)))
            {
                return Path.Combine(folder, "assets");
            }
        }

        throw new DirectoryNotFoundException("expected the folder 'assets' above the program");
    }
}
