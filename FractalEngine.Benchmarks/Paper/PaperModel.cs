using FractalEngine.Benchmarks.Measuring;
using FractalEngine.Core.Generation;
using FractalEngine.Core.Scenes;
using FractalEngine.Parsing.Assets;
using FractalEngine.Parsing.Meshes;

namespace FractalEngine.Benchmarks.Paper;

/// <summary>A model of figure 16, and what figures 17 and 18 print of it.</summary>
/// <param name="Id">The paper's number.</param>
/// <param name="Name">Of a generator, since the paper's meshes are not public, or of a fractal of the assets.</param>
/// <param name="Shape">Of a fractal: faces of the base, transformations a level, depth (b, t, d).</param>
/// <param name="LoadSeconds">The mean of ten runs on a laptop, with the upload to its GPU.</param>
/// <param name="StorageBytes">Of all files of the model.</param>
/// <param name="Faces">Which is also the cost of the simple collider.</param>
/// <param name="FractalCost">Face tests of the fractal collider; null for a mesh.</param>
/// <param name="BoxCost">Face tests of the bounding box collider.</param>
internal sealed record PaperModel(
    int Id, string Name, (int Base, int Maps, int Depth)? Shape, double LoadSeconds, long StorageBytes, long Faces, long? FractalCost,
    long BoxCost)
{
    /// <summary>All five.</summary>
    public static PaperModel[] All { get; } =
    [
        new(1, "spaceship-interior", null, 85.577, 10_799_578, 277_654, null, 1_736),
        new(2, "tree-stump", null, 74.467, 36_871_183, 237_664, null, 1_714),
        new(3, "sierpinski", (10, 7, 5), 0.231, 749, 168_070, 420, 1_666),
        new(4, "diamond", (10, 49, 3), 0.075, 1_176, 1_176_490, 1_470, 1_936),
        new(5, "menger", (12, 20, 5), 0.741, 1_049, 38_400_000, 1_200, 2_419),
    ];

    /// <summary>b·t·d, what §5.2.3 says of the fractal collider.</summary>
    public long? FractalCostFormula => Shape is var (faces, maps, depth) ? (long)faces * maps * depth : null;

    /// <summary>8·12·3·log₈(faces), what figure 18 prints of the bounding box collider, with a depth that is no whole number.</summary>
    public double BoxCostFormula => 8 * 12 * 3 * Math.Log(Faces, 8);

    /// <summary>Where the paper's own numbers disagree; empty where they agree.</summary>
    public string NoteOnFigure17 => FractalCostFormula is { } formula && formula != FractalCost
        ? FormattableString.Invariant(
            $"the paper prints {FractalCost}; its b·t·d is {Shape!.Value.Base}·{Shape.Value.Maps}·{Shape.Value.Depth} = {formula}, and {FractalCost} would be depth {FractalCost / (Shape.Value.Base * Shape.Value.Maps)}")
        : "";

    /// <summary>The same of figure 18.</summary>
    public string NoteOnFigure18 => FormattableString.Invariant(
        $"the paper's {BoxCost} is 8·12·{BoxCostFormula / 96:F2} rounded: no octree has {BoxCostFormula / 96:F2} levels")
        + (NoteOnFigure17 is "" ? "" : "; " + NoteOnFigure17);

    /// <summary>The model's file; a generated mesh is written into a folder.</summary>
    public string EnsureFile(string folder)
    {
        if (Shape is not null)
        {
            return Path.Combine(FractalCase.Assets, "fractals", Name + ".fdo");
        }

        var file = Path.Combine(folder, Name + ".obj");
        using var stream = File.Create(file);
        ObjWriter.Write(MeshGenerators.Create(Name), Name, stream);
        return file;
    }

    /// <summary>Loads it.</summary>
    public static LoadedFile Load(string file) => AssetLoader.Load(file);

    /// <summary>Its only object.</summary>
    public static Model ModelOf(LoadedFile file) => file.Scene.Objects[0].Model;
}
