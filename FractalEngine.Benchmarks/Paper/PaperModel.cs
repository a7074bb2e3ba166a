using FractalEngine.Benchmarks.Measuring;
using FractalEngine.Core.Generation;
using FractalEngine.Core.Scenes;
using FractalEngine.Parsing.Assets;
using FractalEngine.Parsing.Wavefront.Writing;

namespace FractalEngine.Benchmarks.Paper;

/// <summary>A model of figure 16, and what figures 17 and 18 print of it.</summary>
/// <param name="Id">Number of the model in the paper.</param>
/// <param name="Name">Name of a generator, since the paper's meshes are not public, or of a fractal of the assets.</param>
/// <param name="Shape">
/// Shape of a fractal (b, t, d): faces of the base, transformations a level, depth. Null for a mesh.
/// </param>
/// <param name="LoadSeconds">Mean load time of ten runs on a laptop, with the upload to its GPU, in seconds.</param>
/// <param name="StorageBytes">Size of all files of the model in bytes.</param>
/// <param name="Faces">Number of faces, which is also the cost of the simple collider.</param>
/// <param name="FractalCost">Face tests of the fractal collider; null for a mesh.</param>
/// <param name="BoxCost">Face tests of the bounding box collider.</param>
internal sealed record PaperModel(
    int Id, string Name, (int Base, int Maps, int Depth)? Shape, double LoadSeconds, long StorageBytes, long Faces, long? FractalCost,
    long BoxCost)
{
    /// <summary>All five models of the paper.</summary>
    public static PaperModel[] All { get; } =
    [
        new(1, "spaceship-interior", null, 85.577, 10_799_578, 277_654, null, 1_736),
        new(2, "tree-stump", null, 74.467, 36_871_183, 237_664, null, 1_714),
        new(3, "sierpinski", (10, 7, 5), 0.231, 749, 168_070, 420, 1_666),
        new(4, "diamond", (10, 49, 3), 0.075, 1_176, 1_176_490, 1_470, 1_936),
        new(5, "menger", (12, 20, 5), 0.741, 1_049, 38_400_000, 1_200, 2_419),
    ];

    /// <summary>Cost of the fractal collider by §5.2.3: b·t·d. Null for a mesh.</summary>
    public long? FractalCostFormula => Shape is var (faces, maps, depth) ? (long)faces * maps * depth : null;

    /// <summary>
    /// Cost of the bounding box collider by the formula behind figure 18, 8·12·3·log₈(faces), whose depth is no whole number.
    /// </summary>
    public double BoxCostFormula => 8 * 12 * 3 * Math.Log(Faces, 8);

    /// <summary>Note on where the paper's own numbers in figure 17 disagree; empty where they agree.</summary>
    public string NoteOnFigure17
    {
        get
        {
            if (Shape is not var (faces, maps, depth) || FractalCostFormula == FractalCost)
            {
                return "";
            }

            var formula = FormattableString.Invariant($"{faces}·{maps}·{depth} = {FractalCostFormula}");
            var impliedDepth = FormattableString.Invariant($"{FractalCost} would be depth {FractalCost / (faces * maps)}");
            return FormattableString.Invariant($"the paper prints {FractalCost}; its b·t·d is {formula}, and {impliedDepth}");
        }
    }

    /// <summary>Note on where the paper's own numbers in figure 18 disagree.</summary>
    public string NoteOnFigure18
    {
        get
        {
            var levels = FormattableString.Invariant($"{BoxCostFormula / 96:F2}");
            var note = FormattableString.Invariant($"the paper's {BoxCost} is 8·12·{levels} rounded: no octree has {levels} levels");
            return NoteOnFigure17 is "" ? note : $"{note}; {NoteOnFigure17}";
        }
    }

    /// <summary>Returns the path of the model's file. A generated mesh is written into the folder first.</summary>
    public string EnsureFile(string folder)
    {
        if (Shape is not null)
        {
            return Path.Combine(FractalCase.Assets, "fractals", Name + ".fdo");
        }

        var file = Path.Combine(folder, Name + ".obj");
        using var stream = File.Create(file);
        ObjMeshWriter.Write(MeshGenerators.Create(Name), stream, Name);
        return file;
    }

    /// <summary>Loads a model's file with all that it refers to.</summary>
    public static LoadedFile Load(string file) => AssetLoader.Load(file);

    /// <summary>Returns the model of a file's only object.</summary>
    public static Model ModelOf(LoadedFile file) => file.Scene.Objects[0].Model;
}
